#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
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

/// q̇1 = q̇0 - h M⁻¹ ∂V/∂q(q0), q1 = q0 + h q̇1: first order, symplectic, and stable for h < 2/ω, ω² the largest
/// eigenvalue of M⁻¹ ∂²V/∂q². A longer step is divided. [Hairer, Lubich and Wanner 2006, Sec. I.1.2]
class SymplecticEuler : public Integrator {
public:
  SymplecticEuler(const SolverSettings& settings, const Model& model)
      : linear_solver_((check(settings), settings.blas_threads)), K_(model.pattern()) {
    hold(model, model.held(0.0));
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
    const VecX q0 = q;
    if (held_->is_driven()) {
      held_->place(t + h, q);
      const VecX driven = held_->pins().pinned_part((q - q0) / h - qdot) / h;
      linear_solver_.solve(f - model.mass_times(driven), acceleration_);
      acceleration_ += driven;
    } else {
      linear_solver_.solve(f, acceleration_);
    }
    qdot += h * acceleration_;
    q = q0 + h * qdot;
    if (held_->is_driven()) held_->place(t + h, q);  // to the bit
    report.account(*held_, model.mass_times(acceleration_) - f, load, q - q0);
  }

  /// 2/ω of the free vertices, by Lanczos's method for K v = ω² M v from a fixed vector on; infinite when
  /// nothing pushes back. [s]
  double stable_step(const Model& model, const VecX& q) {
    K_.set_zero();
    for (const auto& term : model.energies()) term->add_hessian(q, 1.0, HessianKind::exact, K_);
    VecX v = noise(q.size()), before = VecX::Zero(q.size());
    held_->pins().clear_pinned(v);
    std::vector<double> diagonal, beside;
    double beta = std::sqrt(v.dot(model.mass_times(v)));
    while (static_cast<int>(diagonal.size()) < kLanczosSteps && beta > 0.0) {
      v /= beta;
      VecX Kv = K_.times(v);
      held_->pins().clear_pinned(Kv);
      const double alpha = v.dot(Kv);
      diagonal.push_back(alpha);
      VecX w;
      linear_solver_.solve(Kv, w);
      w -= alpha * v;
      if (diagonal.size() > 1) w -= beside.back() * before;
      beta = std::sqrt(std::max(w.dot(model.mass_times(w)), 0.0));
      if (!(beta > 1e-12 * std::abs(alpha))) beta = 0.0;  // an invariant subspace: its eigenvalues are exact
      beside.push_back(beta);
      before = std::move(v);
      v = std::move(w);
    }
    const double omega2 = largest_eigenvalue(diagonal, beside);
    return omega2 > 0.0 ? 2.0 / std::sqrt(omega2) : std::numeric_limits<double>::infinity();
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
  VecX acceleration_;
  bool has_mass_ = false;
};

}  // namespace

std::unique_ptr<Integrator> make_symplectic_euler(const SolverSettings& settings, const Model& model) {
  return std::make_unique<SymplecticEuler>(settings, model);
}

}  // namespace lagomorph::sim
