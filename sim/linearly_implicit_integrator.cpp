#include <cmath>
#include <optional>
#include <utility>

#include "sim/integrators.h"
#include "sim/linear_solver.h"
#include "sim/newton.h"
#include "sim/solve_counts.h"
#include "sim/solver_trial.h"
#include "sim/system_solver.h"
#include "sim/vertex_rotations.h"

namespace lagomorph::sim {

namespace {

/// How often a solution is corrected by its own residual. An LDLᵀ without pivoting may need it.
constexpr int kMaxRefinements = 5;
constexpr double kPartOfItsTolerance = 0.3;  // of the step's, that a system is solved to

/// (M + h² K) q̇1 = M q̇0 - h ∂V/∂q, q1 = q0 + h q̇1, with K = ∂²V/∂q² and ∂V/∂q at q0: the first Newton
/// iteration of backward Euler from q0 on; loads at the end of the step. K is exact, or projected element by
/// element where solver.hessian says so. (lecture, "Linearly implicit Euler") Damping adds h C, with the same
/// C as in backward Euler.
class LinearlyImplicitEuler : public Integrator {
public:
  LinearlyImplicitEuler(const SolverSettings& settings, const Model& model)
      : tolerance_((check(settings), settings.tolerance)),
        kind_(settings.hessian == "projected" ? HessianKind::projected : HessianKind::exact),
        solver_(settings),
        indefinite_(settings.blas_threads),
        A_(model.pattern()) {
    if (!model.damping().is_none()) C_.emplace(model.pattern());
  }

  std::string_view name() const override { return "linearly_implicit_euler"; }
  int history_levels() const override { return 0; }

  StepReport step(const Model& model, State& state, double h) override {
    const Held& held = model.held(state.t + 0.5 * h);
    hold(model, held.pins());
    try_at_rest(solver_, h, model, held.pins(), {1.0, h * h}, A_);
    solver_.begin(h, [&] { return vertex_rotations(model.mesh(), state.q); });
    const VecX load = model.load_force(state.t + h);
    const VecX b = assemble(model, state, load, h);
    if (!b.allFinite()) return {StepStatus::not_finite, 0, 0.0, h};
    VecX q1 = state.q;
    if (held.is_driven()) held.place(state.t + h, q1);
    VecX qdot1 = state.qdot;
    pins_->clear_pinned(qdot1);
    qdot1 += pins_->pinned_part((q1 - state.q) / h);
    StepReport report = solve(model, b, h, qdot1);
    if (!is_good(report.status)) return report;
    q1 = state.q + h * qdot1;
    if (held.is_driven()) held.place(state.t + h, q1);  // to the bit
    if (!is_defined(model, q1)) report.status = StepStatus::not_finite;
    if (!is_good(report.status)) return report;
    report.account(held, (A_.times(qdot1) - b) / h, load, q1 - state.q);
    if (C_) report.damping_loss = h * qdot1.dot(C_->times(qdot1));
    report.error = 0.5 * h * largest_free(held.pins(), qdot1 - state.qdot);
    state.q = std::move(q1);
    state.qdot = std::move(qdot1);
    state.t += h;
    return report;
  }

private:
  void hold(const Model& model, const Pins& pins) {
    if (pins_ == &pins) return;
    solver_.analyze(model.pattern(), pins);
    is_analyzed_ = false;
    pins_ = &pins;
  }

  /// Makes A = M + h² K + h C and returns M q̇0 - h ∂V/∂q + h f. [kg m/s]
  VecX assemble(const Model& model, const State& state, const VecX& load, double h) {
    VecX g = VecX::Zero(state.q.size());
    A_.set_zero();
    for (const auto& term : model.energies()) {
      term->add_gradient(state.q, 1.0, g);
      term->add_hessian(state.q, h * h, kind_, A_);
    }
    model.add_mass(1.0, A_);
    if (load.size() != 0) g -= load;
    if (C_) {
      model.damping().assemble(model.energies(), moved_on(model, state, 0.5 * h), *C_);
      A_.add(h, *C_);
    }
    return model.mass_times(state.qdot) - h * g;
  }

  /// A x = r over the free coordinates, to `tolerance` |r|, or as exactly as an LDLᵀ does where A is not
  /// positive definite. False when there is none.
  bool solve_once(const Model& model, const VecX& r, double tolerance, VecX& x) {
    if (!is_indefinite_) {
      const FactorStatus status = solver_.solve(A_, r, tolerance, tolerance, x);
      if (status == FactorStatus::ok) return true;
      if (!is_analyzed_) indefinite_.analyze(model.pattern(), *pins_);
      is_analyzed_ = true;
      ++indefinite_factorizations_;
      if (indefinite_.factorize_indefinite(A_) != FactorStatus::ok) return false;
      is_indefinite_ = true;
    }
    indefinite_.solve(r, x);
    return true;
  }

  /// Solves A q̇1 = b from q̇1 on, which stays as it comes where held, and corrects it by its residual, as a
  /// force, while that is above the tolerance and falls.
  StepReport solve(const Model& model, const VecX& b, double h, VecX& qdot1) {
    const SolveCounts before = solver_.counts();
    is_indefinite_ = false;
    indefinite_factorizations_ = 0;
    double reference = pins_->free_norm(model.gravity_force());
    if (reference == 0.0) reference = pins_->free_norm(b) / h;
    const auto force_norm = [&](const VecX& of) { return pins_->free_norm(of) / h; };
    VecX correction, r = b - A_.times(qdot1);
    double norm = force_norm(r);
    for (int i = 0; i <= kMaxRefinements && norm > kPartOfItsTolerance * tolerance_ * reference; ++i) {
      if (i > 0 && norm <= tolerance_ * reference) break;
      const double enough = kPartOfItsTolerance * tolerance_ * reference / norm;
      if (!solve_once(model, r, enough, correction)) return {StepStatus::not_positive, 1, 0.0, h};
      const VecX refined = qdot1 + correction;
      r = b - A_.times(refined);
      const double refined_norm = force_norm(r);
      if (i > 0 && !(refined_norm < norm)) break;
      qdot1 = refined;
      norm = refined_norm;
    }
    StepReport report{StepStatus::converged, 1, reference > 0.0 ? norm / reference : 0.0, h};
    report.solves = solver_.counts() - before;
    report.solves.factorizations += indefinite_factorizations_;
    if (!std::isfinite(norm)) {
      report.status = StepStatus::not_finite;
    } else if (norm > tolerance_ * reference) {
      const bool at_floor = norm <= kNearRoundingFloor * force_norm(A_.rounding_of_times(qdot1));
      report.status = at_floor ? StepStatus::rounding_floor : StepStatus::not_converged;
    }
    return report;
  }

  double tolerance_;
  HessianKind kind_;
  SystemSolver solver_;
  LinearSolver indefinite_;     // for an A that is not positive definite
  bool is_analyzed_ = false;    // that one
  bool is_indefinite_ = false;  // A of this step
  int indefinite_factorizations_ = 0;
  const Pins* pins_ = nullptr;  // that it is analyzed for
  BlockHessian A_;
  std::optional<BlockHessian> C_;  // of the step, when anything is damped
};

}  // namespace

std::unique_ptr<Integrator> make_linearly_implicit_euler(const TimeSettings&, const SolverSettings& settings,
                                                         const Model& model) {
  return std::make_unique<LinearlyImplicitEuler>(settings, model);
}

}  // namespace lagomorph::sim
