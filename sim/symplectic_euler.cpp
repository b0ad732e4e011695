#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include "sim/integrators.h"
#include "sim/linear_solver.h"
#include "sim/newton.h"

namespace lagomorph::sim {

namespace {

constexpr int kLanczosSteps = 40;
constexpr int kStepsAnEstimate = 32;  // the stable step is found anew after so many
constexpr double kSafety = 0.9;       // part of the stable step that is taken
constexpr double kMostSteps = 1e6;

/// q̇1 = q̇0 - h M⁻¹ (∂V/∂q(q0) + C(q0) q̇0), q1 = q0 + h q̇1: first order, without damping symplectic. With ω²
/// the largest eigenvalue of M⁻¹ ∂²V/∂q² and δ that of M⁻¹ C it is stable for h² ω² + 2 h δ < 4, which is h <
/// 2/ω without damping: of x'' = -δ x' - ω² x the roots of z² - (2 - h² ω² - h δ) z + 1 - h δ leave the unit
/// circle there. A longer step is divided. [Hairer, Lubich and Wanner 2006, Sec. I.1.2]
class SymplecticEuler : public Integrator {
public:
  SymplecticEuler(const SolverSettings& settings, const Model& model)
      : linear_solver_((check(settings), settings.blas_threads)), K_(model.pattern()) {
    hold(model, model.held(0.0));
    if (!model.damping().is_none()) C_.emplace(model.pattern());
  }

  std::string_view name() const override { return "symplectic_euler"; }
  int history_levels() const override { return 0; }

  StepReport step(const Model& model, State& state, double h) override {
    hold(model, model.held(state.t + 0.5 * h));
    if (!has_mass_) return {StepStatus::not_positive, 0, 0.0, h};
    StepReport report{StepStatus::converged, 0, 0.0, h};
    VecX q = state.q, qdot = state.qdot;
    double rest = h;
    int taken = 0;
    report.error = 0.0;
    while (rest > 0.0) {
      const double steps = std::ceil(rest / (kSafety * stable_step(model, q)));
      if (!(taken + steps <= kMostSteps)) return {StepStatus::not_finite, 0, 0.0, h};
      const int now = std::min(static_cast<int>(std::max(steps, 1.0)), kStepsAnEstimate);
      const double dt = rest / std::max(steps, 1.0);
      for (int k = 0; k < now; ++k) advance(model, state.t + (h - rest) + k * dt, dt, q, qdot, report);
      taken += now;
      rest = now < steps ? rest - now * dt : 0.0;
      if (!q.allFinite() || !is_defined(model, q)) return {StepStatus::not_finite, 0, 0.0, h};
    }
    state.q = std::move(q);
    state.qdot = std::move(qdot);
    state.t += h;
    report.steps = taken;
    return report;
  }

private:
  /// M is factorized anew when other coordinates are held.
  void hold(const Model& model, const Held& held) {
    if (held_ == &held) return;
    held_ = &held;
    linear_solver_.analyze(model.pattern(), held.pins());
    K_.set_zero();
    model.add_mass(1.0, K_);
    has_mass_ = linear_solver_.factorize(K_) == FactorStatus::ok;
  }

  /// By h from t on; loads at its start.
  void advance(const Model& model, double t, double h, VecX& q, VecX& qdot, StepReport& report) {
    VecX f = VecX::Zero(q.size());
    for (const auto& term : model.energies()) term->add_gradient(q, -1.0, f);
    const VecX load = model.load_force(t);
    if (load.size() != 0) f += load;
    if (C_) {
      model.damping().assemble(model.energies(), q, *C_);
      const VecX damping = C_->times(qdot);
      f -= damping;
      report.damping_loss += h * qdot.dot(damping);
    }
    const VecX q0 = q;
    if (held_->is_driven()) {
      held_->place(t + h, q);
      const VecX driven = held_->pins().pinned_part((q - q0) / h - qdot) / h;
      linear_solver_.solve(f - model.mass_times(driven), acceleration_);
      acceleration_ += driven;
    } else {
      linear_solver_.solve(f, acceleration_);
    }
    report.error = std::max(*report.error, 0.5 * h * h * largest_free(held_->pins(), acceleration_));
    qdot += h * acceleration_;
    q = q0 + h * qdot;
    if (held_->is_driven()) held_->place(t + h, q);  // to the bit
    report.account(*held_, model.mass_times(acceleration_) - f, load, q - q0);
  }

  /// The positive root of h² ω² + 2 h δ = 4 of the free vertices; infinite when nothing pushes back. [s]
  double stable_step(const Model& model, const VecX& q) {
    K_.set_zero();
    for (const auto& term : model.energies()) term->add_hessian(q, 1.0, HessianKind::exact, K_);
    const double omega2 = std::max(largest_eigenvalue(model, K_), 0.0);
    double delta = 0.0;
    if (C_) {
      model.damping().assemble(model.energies(), q, *C_);
      delta = std::max(largest_eigenvalue(model, *C_), 0.0);
    }
    const double divisor = delta + std::sqrt(delta * delta + 4.0 * omega2);
    return divisor > 0.0 ? 4.0 / divisor : std::numeric_limits<double>::infinity();
  }

  /// λ of A v = λ M v over the free vertices, the largest, by Lanczos's method from a fixed vector on.
  double largest_eigenvalue(const Model& model, const BlockHessian& A) {
    const Eigen::Index size = 3 * A.pattern().vertex_count();
    VecX v = noise(size), before = VecX::Zero(size);
    held_->pins().clear_pinned(v);
    std::vector<double> diagonal, beside;
    double beta = std::sqrt(v.dot(model.mass_times(v)));
    while (static_cast<int>(diagonal.size()) < kLanczosSteps && beta > 0.0) {
      v /= beta;
      VecX Av = A.times(v);
      held_->pins().clear_pinned(Av);
      const double alpha = v.dot(Av);
      diagonal.push_back(alpha);
      VecX w;
      linear_solver_.solve(Av, w);
      w -= alpha * v;
      if (diagonal.size() > 1) w -= beside.back() * before;
      beta = std::sqrt(std::max(w.dot(model.mass_times(w)), 0.0));
      if (!(beta > 1e-12 * std::abs(alpha))) beta = 0.0;  // an invariant subspace: its eigenvalues are exact
      beside.push_back(beta);
      before = std::move(v);
      v = std::move(w);
    }
    return largest_eigenvalue(diagonal, beside);
  }

  /// Of the tridiagonal matrix, and how far off it may be.
  static double largest_eigenvalue(const std::vector<double>& diagonal, const std::vector<double>& beside) {
    const auto n = static_cast<Eigen::Index>(diagonal.size());
    if (n == 0) return 0.0;
    Eigen::MatrixXd T = Eigen::MatrixXd::Zero(n, n);
    T.diagonal() = Eigen::Map<const VecX>(diagonal.data(), n);
    T.diagonal(-1) = Eigen::Map<const VecX>(beside.data(), n - 1);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(T);  // of the lower triangle
    return solver.eigenvalues()[n - 1] + beside.back() * std::abs(solver.eigenvectors()(n - 1, n - 1));
  }

  /// A fixed vector with a part of every mode in it.
  static VecX noise(Eigen::Index size) {
    VecX v(size);
    std::uint32_t state = 1;
    for (double& x : v) {
      state = state * 1664525U + 1013904223U;
      x = static_cast<double>(state >> 8) / 16777216.0 - 0.5;
    }
    return v;
  }

  LinearSolver linear_solver_;  // of M
  const Held* held_ = nullptr;  // that it is made for
  BlockHessian K_;
  std::optional<BlockHessian> C_;  // when anything is damped
  VecX acceleration_;
  bool has_mass_ = false;
};

}  // namespace

std::unique_ptr<Integrator> make_symplectic_euler(const TimeSettings&, const SolverSettings& settings,
                                                  const Model& model) {
  return std::make_unique<SymplecticEuler>(settings, model);
}

}  // namespace lagomorph::sim
