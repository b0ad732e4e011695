#include "sim/integrator.h"

#include <algorithm>
#include <cmath>

#include "sim/error.h"
#include "sim/integrators.h"
#include "sim/text.h"

namespace lagomorph::sim {

std::string_view to_string(StepStatus status) {
  switch (status) {
    case StepStatus::converged:
      return "converged";
    case StepStatus::rounding_floor:
      return "rounding_floor";
    case StepStatus::not_converged:
      return "not_converged";
    case StepStatus::not_positive:
      return "not_positive";
    case StepStatus::not_finite:
      return "not_finite";
  }
  return "unknown";
}

namespace {

struct Row {
  const char* name;
  std::unique_ptr<Integrator> (*make)(const SolverSettings&, const Model&);
};

/// The explicit table: a new integrator is one row.
constexpr Row kTable[] = {
    {"backward_euler", make_backward_euler},
    {"linearly_implicit_euler", make_linearly_implicit_euler},
    {"bdf2", make_bdf2},
    {"implicit_midpoint", make_implicit_midpoint},
    {"trapezoidal", make_trapezoidal},
    {"symplectic_euler", make_symplectic_euler},
};

void check(const TimeSettings& time) {
  if (!(time.fps > 0.0 && std::isfinite(time.fps)))
    throw InputError("time.fps = " + short_number(time.fps) + " must be > 0");
  if (time.substeps < 1)
    throw InputError("time.substeps = " + std::to_string(time.substeps) + " must be >= 1");
}

}  // namespace

void StepReport::account(const Held& held, const VecX& balance, const VecX& load, const VecX& dq) {
  pin_forces = held.forces(balance);
  work_pins += held.pins().pinned_part(balance).dot(dq);
  if (load.size() != 0) work_loads += load.dot(dq);
}

bool is_defined(const Model& model, const VecX& q) {
  return std::all_of(model.energies().begin(), model.energies().end(),
                     [&](const auto& term) { return std::isfinite(term->value(q)); });
}

std::vector<std::string> integrator_names() {
  std::vector<std::string> names;
  for (const Row& row : kTable) names.emplace_back(row.name);
  return names;
}

std::unique_ptr<Integrator> make_integrator(const TimeSettings& time, const SolverSettings& solver,
                                            const Model& model) {
  check(time);
  std::string names;
  for (const Row& row : kTable) {
    if (time.integrator == row.name) return row.make(solver, model);
    names += (names.empty() ? "" : ", ") + std::string(row.name);
  }
  throw InputError("unknown time.integrator '" + time.integrator + "'; valid ones are " + names);
}

namespace {

/// Advances by h, in two halves when it does not converge in one. Returns whether it got there; adds to the
/// report.
bool advance(const Model& model, Integrator& integrator, const SolverSettings& solver, double h, int depth,
             State& state, FrameReport& report) {
  const StepReport step = integrator.step(model, state, h);
  report.newton_iterations += step.newton_iterations;
  if (is_good(step.status)) {
    report.steps += step.steps;
    report.halvings = std::max(report.halvings, depth);
    report.residual = std::max(report.residual, step.residual);
    if (step.status == StepStatus::rounding_floor) report.hit_rounding_floor = true;
    report.pin_forces = step.pin_forces;
    report.work_pins += step.work_pins;
    report.work_loads += step.work_loads;
    return true;
  }
  if (depth < solver.max_halvings)
    return advance(model, integrator, solver, 0.5 * h, depth + 1, state, report) &&
           advance(model, integrator, solver, 0.5 * h, depth + 1, state, report);
  report.status = step.status;
  report.halvings = depth;
  report.residual = step.residual;
  report.reason = "frame " + std::to_string(state.frame + 1) + ": a step of " + short_number(h) +
                  " s at t = " + short_number(state.t) + " s ended " + std::string(to_string(step.status)) +
                  " after " + std::to_string(step.newton_iterations) + " Newton iterations with residual " +
                  short_number(step.residual) + " (tolerance " + short_number(solver.tolerance) +
                  "), halved " + std::to_string(depth) + " times";
  return false;
}

}  // namespace

FrameReport advance_frame(const Model& model, Integrator& integrator, const TimeSettings& time,
                          const SolverSettings& solver, State& state) {
  FrameReport report;
  const State before = state;
  const double h = 1.0 / (time.fps * time.substeps);
  for (int i = 0; i < time.substeps; ++i) {
    if (advance(model, integrator, solver, h, 0, state, report)) continue;
    state = before;
    return report;
  }
  if (report.hit_rounding_floor) report.status = StepStatus::rounding_floor;
  ++state.frame;
  state.t = state.frame / time.fps;  // not the sum of the steps, which rounds
  return report;
}

}  // namespace lagomorph::sim
