#include <utility>

#include "sim/integrators.h"
#include "sim/newton.h"

namespace lagomorph::sim {

namespace {

/// What is left of a frame's time is nothing below this part of the step.
constexpr double kRoundingOfTime = 1e-9;

/// Quasi-static equilibrium ∂V/∂q(q1) = 0 at the end of each frame, found by Newton's method on V; q̇ = 0.
/// Time is but the load's parameter: of r = ∂V/∂q - f, with the loads f at the frame's end, a step h of the
/// time T that is left to it goes to r(q1) = (1 - h/T) r(q0), so that what is out of balance falls linearly
/// to nothing, and what is driven goes that part of its way. From the rest shape under gravity that is the
/// load g t/T. Substeps, and the halving of a step that does not converge, are load steps. [Bonet and Wood
/// 2008, Sec. 9.6]
class Static : public Integrator {
public:
  Static(const TimeSettings& time, const SolverSettings& settings, const Model& model)
      : fps_(time.fps), newton_(model, settings) {}

  std::string_view name() const override { return "static"; }
  int history_levels() const override { return 0; }
  const char* step_name() const override { return "no equilibrium: a load step"; }

  State initial_state(const Model& model) const override {
    State state = model.initial_state();
    state.qdot.setZero();
    return state;
  }

  StepReport step(const Model& model, State& state, double h) override {
    const double end = (state.frame + 1) / fps_;
    double left = 1.0 - h / (end - state.t);
    // A shape that is thrown together has no load that could be taken from it bit by bit.
    if (left <= kRoundingOfTime || !starts_at_rest(model, state)) left = 0.0;
    const Held& held = model.held(end);
    IncrementalPotential phi;
    phi.pins = &held.pins();
    const VecX load = model.load_force(end);
    if (load.size() != 0) phi.f = (1.0 - left) * load;
    if (left > 0.0) {
      if (phi.f.size() == 0) phi.f = VecX::Zero(state.q.size());
      for (const auto& term : model.energies()) term->add_gradient(state.q, left, phi.f);
    }
    if (held.is_driven()) {
      phi.q_held = state.q;
      held.place(end, phi.q_held);
      if (left > 0.0) phi.q_held = left * state.q + (1.0 - left) * phi.q_held;
    }
    VecX q = state.q;
    NewtonReport newton = newton_.minimize(model, phi, q);
    StepReport report{newton.status, newton.iterations, newton.residual, h};
    report.iterates = std::move(newton.iterates);
    report.solves = newton.solves;
    report.error = 0.0;
    if (!is_good(report.status)) return report;
    account(model, held, state, q, left, report);
    state.q = std::move(q);
    state.qdot.setZero();
    state.t += h;
    return report;
  }

private:
  static bool starts_at_rest(const Model& model, const State& state) {
    return state.frame > 0 || model.initial_state().q == as_q(model.mesh().X);
  }

  /// The pins' forces at the end, and the work along the way to there by the trapezoidal rule. Loads that
  /// change during a frame do so in proportion to its time; before the first frame there are none.
  void account(const Model& model, const Held& held, const State& state, const VecX& q1, double left,
               StepReport& report) const {
    const double start = state.frame / fps_, end = (state.frame + 1) / fps_;
    const double before = (state.t - start) * fps_, after = 1.0 - left * (1.0 - before);
    const VecX last = model.load_force(end);
    const VecX first = state.frame > 0 ? model.load_force(start) : VecX();
    const auto load = [&](double part) {
      VecX sum = VecX::Zero(q1.size());
      if (last.size() != 0) sum += part * last;
      if (first.size() != 0) sum += (1.0 - part) * first;
      return sum;
    };
    const auto balance = [&](const VecX& q, const VecX& f) {
      VecX sum = -f;
      for (const auto& term : model.energies()) term->add_gradient(q, 1.0, sum);
      return sum;
    };
    const VecX load0 = load(before), load1 = load(after);
    const VecX balance0 = balance(state.q, load0), balance1 = balance(q1, load1);
    report.account(held, 0.5 * (balance0 + balance1), 0.5 * (load0 + load1), q1 - state.q);
    report.pin_forces = held.forces(balance1);
  }

  double fps_;
  Newton newton_;
};

}  // namespace

std::unique_ptr<Integrator> make_static(const TimeSettings& time, const SolverSettings& settings,
                                        const Model& model) {
  return std::make_unique<Static>(time, settings, model);
}

}  // namespace lagomorph::sim
