#include <cmath>

#include "sim/integrators.h"
#include "sim/linear_solver.h"
#include "sim/newton.h"

namespace lagomorph::sim {

namespace {

/// How often a solution is corrected by its own residual. An LDLᵀ without pivoting may need it.
constexpr int kMaxRefinements = 5;

/// (M + h² K) q̇1 = M q̇0 - h ∂V/∂q, q1 = q0 + h q̇1, with K = ∂²V/∂q² and ∂V/∂q at q0: the first Newton
/// iteration of backward Euler from q0 on. K is exact, never projected. (lecture, "Linearly implicit Euler")
class LinearlyImplicitEuler : public Integrator {
public:
  LinearlyImplicitEuler(const SolverSettings& settings, const Model& model)
      : tolerance_((check(settings), settings.tolerance)),
        linear_solver_(settings.blas_threads),
        A_(model.pattern()) {
    linear_solver_.analyze(model.pattern(), model.pins());
  }

  std::string_view name() const override { return "linearly_implicit_euler"; }
  int history_levels() const override { return 0; }

  StepReport step(const Model& model, State& state, double h) override {
    const VecX b = assemble(model, state, h);
    if (!b.allFinite()) return {StepStatus::not_finite, 0, 0.0, h};
    if (!factorize()) return {StepStatus::not_positive, 1, 0.0, h};
    VecX qdot1;
    StepReport report = solve(model, b, h, qdot1);
    if (!is_good(report.status)) return report;
    const VecX q1 = state.q + h * qdot1;
    if (!is_defined(model, q1)) report.status = StepStatus::not_finite;
    if (!is_good(report.status)) return report;
    state.q = q1;
    state.qdot = std::move(qdot1);
    state.t += h;
    return report;
  }

private:
  /// Makes A = M + h² K and returns M q̇0 - h ∂V/∂q. [kg m/s]
  VecX assemble(const Model& model, const State& state, double h) {
    VecX g = VecX::Zero(state.q.size());
    A_.set_zero();
    for (const auto& term : model.energies()) {
      term->add_gradient(state.q, 1.0, g);
      term->add_hessian(state.q, h * h, HessianKind::exact, A_);
    }
    model.add_mass(1.0, A_);
    return model.mass_times(state.qdot) - h * g;
  }

  bool factorize() {
    FactorStatus status = linear_solver_.factorize(A_);
    if (status == FactorStatus::not_positive_definite) status = linear_solver_.factorize_indefinite(A_);
    return status == FactorStatus::ok;
  }

  /// Solves A q̇1 = b and corrects q̇1 by its residual, as a force, while that is above the tolerance and
  /// falls.
  StepReport solve(const Model& model, const VecX& b, double h, VecX& qdot1) {
    double reference = model.pins().free_norm(model.gravity_force());
    if (reference == 0.0) reference = model.pins().free_norm(b) / h;
    const auto force_norm = [&](const VecX& r) { return model.pins().free_norm(r) / h; };
    linear_solver_.solve(b, qdot1);
    VecX r = b - A_.times(qdot1), correction;
    double norm = force_norm(r);
    for (int i = 0; i < kMaxRefinements && norm > tolerance_ * reference; ++i) {
      linear_solver_.solve(r, correction);
      const VecX refined = qdot1 + correction;
      r = b - A_.times(refined);
      const double refined_norm = force_norm(r);
      if (!(refined_norm < norm)) break;
      qdot1 = refined;
      norm = refined_norm;
    }
    StepReport report{StepStatus::converged, 1, reference > 0.0 ? norm / reference : 0.0, h};
    if (!std::isfinite(norm)) {
      report.status = StepStatus::not_finite;
    } else if (norm > tolerance_ * reference) {
      const bool at_floor = norm <= kNearRoundingFloor * force_norm(A_.rounding_of_times(qdot1));
      report.status = at_floor ? StepStatus::rounding_floor : StepStatus::not_converged;
    }
    return report;
  }

  double tolerance_;
  LinearSolver linear_solver_;
  BlockHessian A_;
};

}  // namespace

std::unique_ptr<Integrator> make_linearly_implicit_euler(const SolverSettings& settings, const Model& model) {
  return std::make_unique<LinearlyImplicitEuler>(settings, model);
}

}  // namespace lagomorph::sim
