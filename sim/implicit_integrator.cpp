#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/integrators.h"
#include "sim/newton.h"

namespace lagomorph::sim {

namespace {

/// A fully implicit scheme: the potential whose minimum is the end of the step, and the velocity there.
struct Scheme {
  const char* name;
  int history_levels;
  IncrementalPotential (*potential)(const Model&, const State&, double h);
  VecX (*velocity)(const State&, const VecX& q1, double h);
};

/// M (q1 - q0 - h q̇0) = -h² ∂V/∂q(q1), q̇1 = (q1 - q0)/h. (lecture, "Backward Euler")
constexpr Scheme kBackwardEuler = {
    .name = "backward_euler",
    .history_levels = 0,
    .potential =
        [](const Model&, const State& s, double h) {
          IncrementalPotential phi;
          phi.m = 1.0 / (h * h);
          phi.q_predicted = s.q + h * s.qdot;
          return phi;
        },
    .velocity = [](const State& s, const VecX& q1, double h) -> VecX { return (q1 - s.q) / h; },
};

/// q1 = 4/3 q0 - 1/3 q₋1 + 2/3 h q̇1, and the same of M q̇ with -∂V/∂q(q1) for its rate: second order, and as
/// little moved by stiff modes as backward Euler. [Hairer and Wanner 1996, Sec. V.1]
constexpr Scheme kBdf2 = {
    .name = "bdf2",
    .history_levels = 1,
    .potential =
        [](const Model&, const State& s, double h) {
          const State::Level& before = s.history.front();
          IncrementalPotential phi;
          phi.m = 9.0 / (4.0 * h * h);
          // By differences: they are exactly zero where pinned.
          phi.q_predicted = s.q + (s.q - before.q) / 3.0 + 2.0 / 9.0 * h * (4.0 * s.qdot - before.qdot);
          return phi;
        },
    .velocity = [](const State& s, const VecX& q1, double h) -> VecX {
      return (3.0 * (q1 - s.q) - (s.q - s.history.front().q)) / (2.0 * h);
    },
};

/// M (q̇1 - q̇0) = -h ∂V/∂q((q0 + q1)/2), q1 - q0 = h (q̇0 + q̇1)/2: second order, symplectic, keeps momentum
/// and angular momentum. [Hairer, Lubich and Wanner 2006, Sec. VI.3]
constexpr Scheme kImplicitMidpoint = {
    .name = "implicit_midpoint",
    .history_levels = 0,
    .potential =
        [](const Model&, const State& s, double h) {
          IncrementalPotential phi;
          phi.m = 2.0 / (h * h);
          phi.q_predicted = s.q + h * s.qdot;
          phi.a = 0.5;
          phi.b = 0.5 * s.q;
          return phi;
        },
    .velocity = [](const State& s, const VecX& q1, double h) -> VecX {
      return 2.0 / h * (q1 - s.q) - s.qdot;
    },
};

/// M (q̇1 - q̇0) = -h/2 (∂V/∂q(q0) + ∂V/∂q(q1)), q1 - q0 = h (q̇0 + q̇1)/2: Newmark's method with β = 1/4,
/// γ = 1/2, second order. [Newmark 1959]
constexpr Scheme kTrapezoidal = {
    .name = "trapezoidal",
    .history_levels = 0,
    .potential =
        [](const Model& model, const State& s, double h) {
          IncrementalPotential phi;
          phi.m = 4.0 / (h * h);
          phi.q_predicted = s.q + h * s.qdot;
          phi.f = VecX::Zero(s.q.size());
          for (const auto& term : model.energies()) term->add_gradient(s.q, -1.0, phi.f);
          return phi;
        },
    .velocity = kImplicitMidpoint.velocity,
};

class ImplicitIntegrator : public Integrator {
public:
  ImplicitIntegrator(const Scheme& scheme, const SolverSettings& settings, const Model& model)
      : scheme_(scheme), newton_(model, settings) {}

  std::string_view name() const override { return scheme_.name; }
  int history_levels() const override { return scheme_.history_levels; }

  StepReport step(const Model& model, State& state, double h) override {
    const Scheme& scheme = has_history(state, h) ? scheme_ : kBackwardEuler;
    const IncrementalPotential phi = scheme.potential(model, state, h);
    VecX q = first_guess(model, state, h);
    const NewtonReport newton = newton_.minimize(model, phi, q);
    StepReport report{newton.status, newton.iterations, newton.residual, h};
    if (!is_good(report.status)) return report;
    if (phi.a != 1.0 && !is_defined(model, q)) {
      report.status = StepStatus::not_finite;
    } else {
      VecX qdot1 = scheme.velocity(state, q, h);
      advance(state, std::move(q), std::move(qdot1), h);
    }
    return report;
  }

private:
  /// Whether the levels before this one are there and a step h apart. At the start, and after a change of the
  /// step, a multistep scheme begins anew with a step of backward Euler.
  bool has_history(const State& state, double h) const {
    if (state.history.size() < static_cast<std::size_t>(scheme_.history_levels)) return false;
    double t = state.t;
    for (int k = 0; k < scheme_.history_levels; ++k) {
      const double before = state.history[static_cast<std::size_t>(k)].t;
      if (!(std::abs(t - before - h) <= 1e-6 * h)) return false;
      t = before;
    }
    return true;
  }

  /// A function of the state alone, so that a resumed run takes the same way: on along the velocity, as far
  /// as V is defined.
  static VecX first_guess(const Model& model, const State& state, double h) {
    const VecX dq = h * state.qdot;
    double step = 1.0;
    for (const auto& term : model.energies()) step = std::min(step, term->max_step(state.q, dq));
    return state.q + step * dq;
  }

  void advance(State& state, VecX q1, VecX qdot1, double h) const {
    if (scheme_.history_levels > 0) {
      state.history.insert(state.history.begin(), {state.t, std::move(state.q), std::move(state.qdot)});
      if (state.history.size() > static_cast<std::size_t>(scheme_.history_levels)) state.history.pop_back();
    }
    state.q = std::move(q1);
    state.qdot = std::move(qdot1);
    state.t += h;
  }

  Scheme scheme_;
  Newton newton_;
};

}  // namespace

std::unique_ptr<Integrator> make_backward_euler(const SolverSettings& settings, const Model& model) {
  return std::make_unique<ImplicitIntegrator>(kBackwardEuler, settings, model);
}
std::unique_ptr<Integrator> make_bdf2(const SolverSettings& settings, const Model& model) {
  return std::make_unique<ImplicitIntegrator>(kBdf2, settings, model);
}
std::unique_ptr<Integrator> make_implicit_midpoint(const SolverSettings& settings, const Model& model) {
  return std::make_unique<ImplicitIntegrator>(kImplicitMidpoint, settings, model);
}
std::unique_ptr<Integrator> make_trapezoidal(const SolverSettings& settings, const Model& model) {
  return std::make_unique<ImplicitIntegrator>(kTrapezoidal, settings, model);
}

}  // namespace lagomorph::sim
