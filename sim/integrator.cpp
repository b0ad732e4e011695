#include "sim/integrator.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include "sim/error.h"
#include "sim/integrators.h"
#include "sim/text.h"

namespace lagomorph::sim {

namespace {

struct StatusRow {
  StepStatus status;
  std::string_view word;
  const char* sentence;  // how a step ended
};
constexpr StatusRow kStatuses[] = {
    {StepStatus::converged, "converged", "converged"},
    {StepStatus::rounding_floor, "rounding_floor", "came to the rounding floor"},
    {StepStatus::not_converged, "not_converged", "did not converge"},
    {StepStatus::not_positive, "not_positive", "had no positive definite system"},
    {StepStatus::not_finite, "not_finite", "gave values that are not finite"},
    {StepStatus::inaccurate, "inaccurate", "was too inaccurate"},
};

const StatusRow& row_of(StepStatus status) {
  return *std::find_if(std::begin(kStatuses), std::end(kStatuses),
                       [&](const StatusRow& row) { return row.status == status; });
}

}  // namespace

std::string_view to_string(StepStatus status) { return row_of(status).word; }

StepStatus step_status(std::string_view text) {
  for (const StatusRow& row : kStatuses)
    if (row.word == text) return row.status;
  throw InputError("unknown status of a step '" + std::string(text) + "'");
}

namespace {

struct IntegratorRow {
  const char* name;
  std::unique_ptr<Integrator> (*make)(const TimeSettings&, const SolverSettings&, const Model&);
};

/// The explicit table: a new integrator is one row.
constexpr IntegratorRow kTable[] = {
    {"backward_euler", make_backward_euler},
    {"linearly_implicit_euler", make_linearly_implicit_euler},
    {"bdf2", make_bdf2},
    {"implicit_midpoint", make_implicit_midpoint},
    {"trapezoidal", make_trapezoidal},
    {"symplectic_euler", make_symplectic_euler},
    {"static", make_static},
};

void check(const TimeSettings& time) {
  if (!(time.fps > 0.0 && std::isfinite(time.fps)))
    throw InputError("time.fps = " + short_number(time.fps) + " must be > 0");
  if (time.substeps < 1)
    throw InputError("time.substeps = " + std::to_string(time.substeps) + " must be >= 1");
  if (time.error_tolerance && !(*time.error_tolerance > 0.0))
    throw InputError("time.error_tolerance = " + short_number(*time.error_tolerance) + " must be > 0 m");
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

VecX moved_on(const Model& model, const State& state, double h) {
  const VecX dq = h * state.qdot;
  double step = 1.0;
  for (const auto& term : model.energies()) step = std::min(step, term->max_step(state.q, dq));
  return state.q + step * dq;
}

double largest_free(const Pins& pins, const VecX& d) {
  VecX free = d;
  pins.clear_pinned(free);
  return std::sqrt(as_points(free).rowwise().squaredNorm().maxCoeff());
}

std::vector<std::string> integrator_names() {
  std::vector<std::string> names;
  for (const IntegratorRow& row : kTable) names.emplace_back(row.name);
  return names;
}

std::unique_ptr<Integrator> make_integrator(const TimeSettings& time, const SolverSettings& solver,
                                            const Model& model) {
  check(time);
  std::string names;
  for (const IntegratorRow& row : kTable) {
    if (time.integrator == row.name) return row.make(time, solver, model);
    names += (names.empty() ? "" : ", ") + std::string(row.name);
  }
  throw InputError("unknown time.integrator '" + time.integrator + "'; valid ones are " + names);
}

namespace {

/// What steps are taken with.
struct Stepping {
  const Model& model;
  Integrator& integrator;
  const TimeSettings& time;
  const SolverSettings& solver;
};

/// The report of two steps as one.
StepReport joined(const StepReport& a, const StepReport& b) {
  StepReport both = is_good(b.status) && a.status == StepStatus::rounding_floor ? a : b;
  both.newton_iterations = a.newton_iterations + b.newton_iterations;
  both.solves = a.solves;
  both.solves += b.solves;
  both.residual = std::max(a.residual, b.residual);
  both.h = a.h + b.h;
  both.steps = a.steps + b.steps;
  both.damping_loss = a.damping_loss + b.damping_loss;
  both.work_pins = a.work_pins + b.work_pins;
  both.work_loads = a.work_loads + b.work_loads;
  both.pin_forces = b.pin_forces;
  return both;
}

/// One step with its log.
StepReport take_step(const Stepping& with, double h, State& state, FrameReport& report) {
  const double t = state.t;
  StepReport step = with.integrator.step(with.model, state, h);
  report.newton_iterations += step.newton_iterations;
  report.solves += step.solves;
  if (!step.iterates.empty()) report.newton.push_back({t, h, step.status, std::move(step.iterates)});
  return step;
}

/// A step whose error is known where it has to be: by the scheme's own estimate, or by halves, which are
/// kept.
StepReport take_measured_step(const Stepping& with, double h, State& state, FrameReport& report) {
  const State before = state;
  StepReport step = take_step(with, h, state, report);
  if (!with.time.error_tolerance || !is_good(step.status)) return step;
  if (!step.error) {
    const VecX whole = std::exchange(state, before).q;
    step = take_step(with, 0.5 * h, state, report);
    if (is_good(step.status)) step = joined(step, take_step(with, 0.5 * h, state, report));
    if (is_good(step.status))
      step.error = largest_free(with.model.held(before.t + 0.5 * h).pins(), whole - state.q) / 3.0;
  }
  if (is_good(step.status) && !(*step.error <= *with.time.error_tolerance))
    step.status = StepStatus::inaccurate;
  if (!is_good(step.status)) state = before;
  return step;
}

std::string reason_of(const Stepping& with, const StepReport& step, const State& state, int depth) {
  std::string how =
      "residual " + short_number(step.residual) + " (tolerance " + short_number(with.solver.tolerance) + ")";
  if (step.status == StepStatus::inaccurate)
    how = "an estimated error of " + short_number(*step.error) + " m (tolerance " +
          short_number(*with.time.error_tolerance) + ")";
  const bool loose = with.integrator.name() == "static" && with.model.held(state.t).pins().vertices().empty();
  const std::string hint = loose ? "; nothing is pinned" : "";
  return "frame " + std::to_string(state.frame + 1) + ": " + with.integrator.step_name() + " of " +
         short_number(step.h) + " s at t = " + short_number(state.t) + " s " + row_of(step.status).sentence +
         " after " + std::to_string(step.newton_iterations) + " Newton iterations with " + how + ", halved " +
         std::to_string(depth) + " times" + hint;
}

/// Advances by h, in two halves when one step will not do. Returns whether it got there; adds to the report.
bool advance(const Stepping& with, double h, int depth, State& state, FrameReport& report) {
  const StepReport step = take_measured_step(with, h, state, report);
  if (is_good(step.status)) {
    report.steps += step.steps;
    report.halvings = std::max(report.halvings, depth);
    report.residual = std::max(report.residual, step.residual);
    report.damping_loss += step.damping_loss;
    if (with.time.error_tolerance) report.error = std::max(report.error, *step.error);
    if (step.status == StepStatus::rounding_floor) report.hit_rounding_floor = true;
    report.pin_forces = step.pin_forces;
    report.work_pins += step.work_pins;
    report.work_loads += step.work_loads;
    return true;
  }
  ++report.rejected;
  if (depth < with.solver.max_halvings)
    return advance(with, 0.5 * h, depth + 1, state, report) &&
           advance(with, 0.5 * h, depth + 1, state, report);
  report.status = step.status;
  report.halvings = depth;
  report.residual = step.residual;
  report.reason = reason_of(with, step, state, depth);
  return false;
}

}  // namespace

FrameReport advance_frame(const Model& model, Integrator& integrator, const TimeSettings& time,
                          const SolverSettings& solver, State& state) {
  FrameReport report;
  const State before = state;
  const double h = 1.0 / (time.fps * time.substeps);
  for (int i = 0; i < time.substeps; ++i) {
    if (advance({model, integrator, time, solver}, h, 0, state, report)) continue;
    state = before;
    return report;
  }
  if (report.hit_rounding_floor) report.status = StepStatus::rounding_floor;
  ++state.frame;
  state.t = state.frame / time.fps;  // not the sum of the steps, which rounds
  return report;
}

}  // namespace lagomorph::sim
