#include <utility>

#include "sim/integrators.h"
#include "sim/newton.h"

namespace lagomorph::sim {

namespace {

/// A fully implicit scheme: the potential whose minimum is the end of the step, and the velocity there.
struct Scheme {
  const char* name;
  int history_levels;
  IncrementalPotential (*potential)(const State&, double h);
  VecX (*velocity)(const State&, const VecX& q1, double h);
};

/// M (q1 - q0 - h q̇0) = -h² ∂V/∂q(q1), q̇1 = (q1 - q0)/h. (lecture, "Backward Euler")
constexpr Scheme kBackwardEuler = {
    .name = "backward_euler",
    .history_levels = 0,
    .potential =
        [](const State& s, double h) {
          IncrementalPotential phi;
          phi.m = 1.0 / (h * h);
          phi.q_predicted = s.q + h * s.qdot;
          return phi;
        },
    .velocity = [](const State& s, const VecX& q1, double h) -> VecX { return (q1 - s.q) / h; },
};

class ImplicitIntegrator : public Integrator {
public:
  ImplicitIntegrator(const Scheme& scheme, const SolverSettings& settings, const Model& model)
      : scheme_(scheme), newton_(model, settings) {}

  std::string_view name() const override { return scheme_.name; }
  int history_levels() const override { return scheme_.history_levels; }

  StepReport step(const Model& model, State& state, double h) override {
    const IncrementalPotential phi = scheme_.potential(state, h);
    VecX q = first_guess(model, state, h);
    const NewtonReport newton = newton_.minimize(model, phi, q);
    if (is_good(newton.status)) advance(state, std::move(q), h);
    return {newton.status, newton.iterations, newton.residual, h};
  }

private:
  /// A function of the state alone, so that a resumed run takes the same way: on along the velocity, as far
  /// as V is defined.
  static VecX first_guess(const Model& model, const State& state, double h) {
    const VecX dq = h * state.qdot;
    double step = 1.0;
    for (const auto& term : model.energies()) step = std::min(step, term->max_step(state.q, dq));
    return state.q + step * dq;
  }

  void advance(State& state, VecX q1, double h) const {
    VecX qdot1 = scheme_.velocity(state, q1, h);
    if (scheme_.history_levels > 0) {
      state.history.insert(state.history.begin(), {std::move(state.q), std::move(state.qdot)});
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

}  // namespace lagomorph::sim
