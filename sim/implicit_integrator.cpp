#include <cmath>
#include <optional>
#include <utility>

#include "sim/integrators.h"
#include "sim/newton.h"

namespace lagomorph::sim {

namespace {

/// Dead loads in the balance of a step: at its end, in its middle, and the mean of both ends. [N]
VecX load_at_end(const Model& model, double t, double h) { return model.load_force(t + h); }
VecX load_in_middle(const Model& model, double t, double h) { return model.load_force(t + 0.5 * h); }
VecX mean_load(const Model& model, double t, double h) {
  return 0.5 * (model.load_force(t) + model.load_force(t + h));
}

/// The velocity u = rate/h (q1 - q_still) that is damped, and where. Damping forces -C(q*) u with a C that is
/// constant within the step add a convex quadratic to Φ, and so the step stays a minimization and its loss
/// h uᵀ C u is never negative. q* is predicted along q̇0, off by h²/2 q̈, for the time at which u is the
/// velocity up to h²: that keeps the order of each scheme, and what viscosity takes from a rotation is only
/// that error's.
struct Damped {
  double rate = 1.0;
  double at = 0.5;  // q* = q0 + at h q̇0
  VecX (*q_still)(const State&) = [](const State& s) -> VecX { return s.q; };
};
constexpr Damped kDampedInTheMiddle = {};

/// A fully implicit scheme: the potential whose minimum is the end of the step, and the velocity there.
struct Scheme {
  const char* name;
  int history_levels;
  IncrementalPotential (*potential)(const Model&, const State&, double h);
  VecX (*velocity)(const State&, const VecX& q1, double h);
  VecX (*load)(const Model&, double t, double h);
  double weight = 1.0;  // ∂Φ/∂q is so many times M (q̇1 - q̇0)/h, or what stands for it, plus the other forces
  /// q1 - q0 = h (q̇0 + q̇1)/2: driven coordinates would swing about their velocity for ever, so they are given
  /// that of their motion, and M (q̇1 - q̇0) has it.
  bool gives_driven_velocity = false;
  Damped damped = kDampedInTheMiddle;
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
    .load = load_at_end,
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
    .load = load_at_end,
    .damped = {.rate = 1.5,
               .at = 1.0,
               .q_still = [](const State& s) -> VecX { return s.q + (s.q - s.history.front().q) / 3.0; }},
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
    .load = load_in_middle,
    .gives_driven_velocity = true,
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
    .load = mean_load,
    .weight = 2.0,
    .gives_driven_velocity = true,
};

class ImplicitIntegrator : public Integrator {
public:
  ImplicitIntegrator(const Scheme& scheme, const SolverSettings& settings, const Model& model)
      : scheme_(scheme), newton_(model, settings) {
    if (!model.damping().is_none()) C_.emplace(model.pattern());
  }

  std::string_view name() const override { return scheme_.name; }
  int history_levels() const override { return scheme_.history_levels; }

  StepReport step(const Model& model, State& state, double h) override {
    const Scheme& scheme = has_history(state, h) ? scheme_ : kBackwardEuler;
    const Held& held = model.held(state.t + 0.5 * h);
    IncrementalPotential phi = scheme.potential(model, state, h);
    phi.pins = &held.pins();
    const VecX load = scheme.load(model, state.t, h);
    if (load.size() != 0)
      phi.f = phi.f.size() != 0 ? VecX(phi.f + scheme.weight * load) : VecX(scheme.weight * load);
    if (held.is_driven()) drive(scheme, held, state, h, phi);
    if (C_) damp(scheme, model, state, h, phi);
    VecX q = moved_on(model, state, h);  // a function of the state alone: a resumed run takes the same way
    NewtonReport newton = newton_.minimize(model, phi, q);
    StepReport report{newton.status, newton.iterations, newton.residual, h};
    report.iterates = std::move(newton.iterates);
    report.solves = newton.solves;
    if (!is_good(report.status)) return report;
    if (phi.a != 1.0 && !is_defined(model, q)) {
      report.status = StepStatus::not_finite;
    } else {
      report.account(held, newton.balance / scheme.weight, load, q - state.q);
      if (C_) {
        const VecX u = scheme.damped.rate / h * (q - phi.q_still);
        report.damping_loss = h * u.dot(C_->times(u));
      }
      VecX qdot1 = scheme.velocity(state, q, h);
      if (scheme.gives_driven_velocity) held.set_velocities(state.t + h, qdot1);
      report.error = error_estimate(held.pins(), scheme, state, qdot1, h);
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

  /// Tells Φ where the driven coordinates end.
  static void drive(const Scheme& scheme, const Held& held, const State& state, double h,
                    IncrementalPotential& phi) {
    phi.q_held = state.q;
    held.place(state.t + h, phi.q_held);
    if (!scheme.gives_driven_velocity) return;
    // m M (q1 - q̃) = weight M (q̇1 - q̇0)/h with m = 2 weight/h².
    VecX qdot1 = state.qdot, q_predicted = phi.q_held;
    held.set_velocities(state.t + h, qdot1);
    q_predicted -= 0.5 * h * (qdot1 - state.qdot);
    for (int dof = 0; dof < q_predicted.size(); ++dof)
      if (held.pins().is_held(dof)) phi.q_predicted[dof] = q_predicted[dof];
  }

  void damp(const Scheme& scheme, const Model& model, const State& state, double h,
            IncrementalPotential& phi) {
    const Damped& damped = scheme.damped;
    model.damping().assemble(model.energies(), moved_on(model, state, damped.at * h), *C_);
    phi.C = &*C_;
    phi.c = scheme.weight * damped.rate / h;
    phi.q_still = damped.q_still(state);
  }

  /// Of positions at the end of a step. [m] Backward Euler's is h²/2 q̈, with q̈ from the velocities at both
  /// ends; BDF2's is 2/9 h³ d³q/dt³, from three velocities. The others' takes more than a step to tell.
  static std::optional<double> error_estimate(const Pins& pins, const Scheme& scheme, const State& state,
                                              const VecX& qdot1, double h) {
    if (scheme.velocity == kBackwardEuler.velocity) return 0.5 * h * largest_free(pins, qdot1 - state.qdot);
    if (scheme.velocity == kBdf2.velocity)
      return 2.0 / 9.0 * h * largest_free(pins, qdot1 - 2.0 * state.qdot + state.history.front().qdot);
    return std::nullopt;
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
  std::optional<BlockHessian> C_;  // of the step, when anything is damped
};

}  // namespace

std::unique_ptr<Integrator> make_backward_euler(const TimeSettings&, const SolverSettings& settings,
                                                const Model& model) {
  return std::make_unique<ImplicitIntegrator>(kBackwardEuler, settings, model);
}
std::unique_ptr<Integrator> make_bdf2(const TimeSettings&, const SolverSettings& settings,
                                      const Model& model) {
  return std::make_unique<ImplicitIntegrator>(kBdf2, settings, model);
}
std::unique_ptr<Integrator> make_implicit_midpoint(const TimeSettings&, const SolverSettings& settings,
                                                   const Model& model) {
  return std::make_unique<ImplicitIntegrator>(kImplicitMidpoint, settings, model);
}
std::unique_ptr<Integrator> make_trapezoidal(const TimeSettings&, const SolverSettings& settings,
                                             const Model& model) {
  return std::make_unique<ImplicitIntegrator>(kTrapezoidal, settings, model);
}

}  // namespace lagomorph::sim
