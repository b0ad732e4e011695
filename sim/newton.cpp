#include "sim/newton.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "sim/error.h"
#include "sim/profile.h"
#include "sim/rigid_motion.h"
#include "sim/solver_trial.h"
#include "sim/text.h"
#include "sim/vertex_rotations.h"

namespace lagomorph::sim {

void check(const SolverSettings& s) {
  if (!(s.tolerance > 0.0 && s.tolerance < 1.0))
    throw InputError("solver.tolerance = " + short_number(s.tolerance) + " must be in (0, 1)");
  if (s.max_iterations < 1)
    throw InputError("solver.max_iterations = " + std::to_string(s.max_iterations) + " must be >= 1");
  if (s.max_halvings < 0 || s.max_halvings > 20)
    throw InputError("solver.max_halvings = " + std::to_string(s.max_halvings) + " must be in 0 .. 20");
  if (s.blas_threads < 1)
    throw InputError("solver.blas_threads = " + std::to_string(s.blas_threads) + " must be >= 1");
  if (s.hessian != "auto" && s.hessian != "projected")
    throw InputError("unknown solver.hessian '" + s.hessian + "'; valid ones are auto, projected");
  if (s.linear != "auto" && s.linear != "cholmod" && s.linear != "cg")
    throw InputError("unknown solver.linear '" + s.linear + "'; valid ones are auto, cholmod, cg");
}

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kArmijo = 1e-4;  // part of the predicted decrease that a step must bring
constexpr double kLeastClamping = 1.0 / 64.0;
/// Of the mass that is added to a singular Hessian, over the largest entries of both.
constexpr double kLeastShift = 1e-14, kLargestShift = 1e-2;
/// Work of a direction's rigid part over that of the whole, below which it does none.
constexpr double kIdle = 1e-6;
constexpr double kFarthest = 1e4;         // of a static equilibrium, over the bodies' coordinates
constexpr int kMaxBacktracks = 40;        // halvings of a step while the energy tells steps apart
constexpr int kMaxBlindBacktracks = 8;    // and where only the residual does
constexpr double kLoosest = 1e-3;         // tolerance of a linear system
constexpr double kWhileCarrying = 1e-3;   // likewise, while held coordinates are on their way
constexpr double kPartOfTolerance = 0.3;  // of Newton's, that a linear system need not be solved beyond
constexpr double kLittleLeft = 0.02;      // part of |g| that is to be left, with which the Hessian is kept
constexpr int kMaxCarries = 8;            // pieces in which the held coordinates may reach their places

/// Where V is evaluated.
VecX position_of_V(const IncrementalPotential& phi, const VecX& q) {
  if (phi.a == 1.0 && phi.b.size() == 0) return q;
  VecX x = phi.a * q;
  if (phi.b.size() != 0) x += phi.b;
  return x;
}

/// Part of the direction that keeps V defined: it moves by a · direction when q moves by it.
double max_step(const Model& model, const IncrementalPotential& phi, const VecX& q, const VecX& direction) {
  double step = 1.0;
  for (const auto& term : model.energies())
    step = std::min(step, term->max_step(position_of_V(phi, q), phi.a * direction));
  return step;
}

}  // namespace

/// Φ and its gradient at a q.
struct Newton::Point {
  VecX q, g;                 // g is zero where held
  VecX balance;              // ∂Φ/∂q with what the pins exert [N]
  double value = 0.0;        // Φ [J]
  double value_scale = 0.0;  // size of the numbers that it is summed from [J]
  double norm = 0.0;         // |g_free| [N]
  double reference = 0.0;    // what norm is measured by [N]

  bool is_finite() const { return std::isfinite(norm) && std::isfinite(value); }
  double residual() const { return reference > 0.0 ? norm / reference : 0.0; }
};

Newton::Newton(const Model& model, const SolverSettings& settings)
    : settings_((check(settings), settings)), solver_(settings), pins_(&model.pins()), H_(model.pattern()) {
  solver_.analyze(model.pattern(), pins());
}

Newton::Point Newton::evaluate(const Model& model, const IncrementalPotential& phi, VecX q) const {
  Point p;
  p.q = std::move(q);
  const VecX x = position_of_V(phi, p.q);
  VecX forces = VecX::Zero(x.size());
  {
    const Timed timed(Stage::gradient);
    for (const auto& term : model.energies()) term->add_gradient(x, 1.0, forces);
  }
  const Timed timed(Stage::energy);
  for (const auto& term : model.energies()) {
    const double value = term->value(x);
    p.value += value / phi.a;
    p.value_scale += (std::abs(value) + term->value_scale(x)) / phi.a;
  }
  if (phi.f.size() != 0) {
    forces -= phi.f;
    p.value -= phi.f.dot(p.q);
    p.value_scale += phi.f.cwiseAbs().dot(p.q.cwiseAbs());
  }
  if (phi.C != nullptr) {
    const VecX dq = p.q - phi.q_still, damping = phi.c * phi.C->times(dq);
    p.value += 0.5 * dq.dot(damping);
    forces += damping;
  }
  VecX inertia = VecX::Zero(x.size());
  if (phi.m != 0.0) {
    const VecX dq = p.q - phi.q_predicted;
    inertia = phi.m * model.mass_times(dq);
    p.value += 0.5 * dq.dot(inertia);
  }
  p.balance = inertia + forces;
  p.g = p.balance;
  pins().clear_pinned(p.g);
  p.norm = p.g.norm();
  p.reference = pins().free_norm(model.gravity_force());
  // Without gravity: the larger of the parts that must cancel.
  if (p.reference == 0.0) p.reference = std::max(pins().free_norm(inertia), pins().free_norm(forces));
  return p;
}

void Newton::assemble(const Model& model, const IncrementalPotential& phi, const VecX& q, HessianKind kind,
                      BlockHessian& H) const {
  const Timed timed(Stage::hessian);
  const VecX x = position_of_V(phi, q);
  H.set_zero();
  for (const auto& term : model.energies()) term->add_hessian(x, phi.a, kind, H);
  if (phi.m != 0.0) model.add_mass(phi.m, H);
  if (phi.C != nullptr) H.add(phi.c, *phi.C);
}

/// How exactly a system is to be solved: |g| is to fall to `tolerance` times what it is now, and in the end
/// to `end`.
struct Newton::Goal {
  double tolerance = 0.0, end = 0.0;
};

/// By the exact Hessian while that is found to be positive definite, so that Newton stays quadratic. When it
/// is not, negative eigenvalues of elements are clamped, but only by the part that makes the whole positive
/// definite: clamped in full, the elements around a few that buckle are much too stiff, and it takes two to
/// eight times the iterations. `clamping` is that part, kept from one iteration to the next.
FactorStatus Newton::find_direction(const Model& model, const IncrementalPotential& phi, const Point& point,
                                    const VecX& lift, const Goal& goal, double& clamping, VecX& direction) {
  const auto solve = [&] {
    const FactorStatus status =
        solver_.solve(H_, lift.size() == 0 ? VecX(-point.g) : VecX(-point.g - H_.times(lift)), goal.tolerance,
                      goal.end, direction);
    if (lift.size() != 0 && status == FactorStatus::ok) direction += lift;
    return status;
  };
  // The last few digits need no new Hessian: the point has hardly moved since the one before.
  const bool keeps = goal.end >= kLittleLeft && has_fresh_hessian_ && lift.size() == 0;
  has_fresh_hessian_ = !keeps;
  if (keeps) {
    const FactorStatus status = solve();
    if (status == FactorStatus::ok) return status;
    has_fresh_hessian_ = true;
  }
  if (settings_.hessian == "projected") {
    assemble(model, phi, point.q, HessianKind::projected, H_);
    used_clamping_ = 1.0;
    const FactorStatus status = solve();
    return status == FactorStatus::not_positive_definite ? solve_shifted(model, solve) : status;
  }
  assemble(model, phi, point.q, HessianKind::exact, H_);
  used_clamping_ = 0.0;
  FactorStatus status = solve();
  if (status != FactorStatus::not_positive_definite) return status;
  exact_ = H_;
  if (!projected_) projected_.emplace(model.pattern());
  assemble(model, phi, point.q, HessianKind::projected, *projected_);
  for (clamping = std::max(kLeastClamping, 0.5 * clamping);; clamping *= 4.0) {
    clamping = std::min(clamping, 1.0);
    H_.set_blend(*exact_, *projected_, clamping);
    used_clamping_ = clamping;
    status = solve();
    if (status != FactorStatus::not_positive_definite) return status;
    if (clamping == 1.0) return solve_shifted(model, solve);
  }
}

/// Clamped in full a Hessian may still be singular, or so to rounding, where nothing holds a body at rest or
/// tets are flat: a little more mass on its diagonal goes downhill all the same.
template <class Solve>
FactorStatus Newton::solve_shifted(const Model& model, Solve&& solve) {
  const auto largest = [](const BlockHessian& A) {
    double found = 0.0;
    for (int k = 0; k < A.pattern().block_count(); ++k)
      found = std::max(found, A.block(k).cwiseAbs().maxCoeff());
    return found;
  };
  BlockHessian mass(model.pattern());
  model.add_mass(1.0, mass);
  const double unit = largest(H_) / largest(mass);
  FactorStatus status = FactorStatus::not_positive_definite;
  double sum = 0.0, shift = kLeastShift;
  while (shift <= kLargestShift) {
    model.add_mass(shift * unit - sum, H_);
    sum = shift * unit;
    status = solve();
    if (status != FactorStatus::not_positive_definite) break;
    shift *= 100.0;
  }
  return status;
}

/// Where nothing holds a body at rest, the Hessian is singular along its rigid motions, and the factor turns
/// the rounding of g into a large one of no use: what of it does no work is taken from the direction.
void Newton::drop_idle_motion(const Model& model, const Point& point, VecX& direction) const {
  const double work = std::abs(point.g.dot(direction));
  std::optional<double> rounding;  // most models have no free body
  for (const Body& body : model.mesh().bodies) {
    const int first = 3 * body.vertices.begin, size = 3 * (body.vertices.end - body.vertices.begin);
    bool free = true;
    for (int dof = first; dof < first + size && free; ++dof) free = !pins().is_held(dof);
    if (!free) continue;
    if (!rounding) rounding = kNearRoundingFloor * rounding_floor(point.q);
    const VecX rigid = rigid_part(point.q.segment(first, size), direction.segment(first, size));
    if (std::abs(point.g.segment(first, size).dot(rigid)) <= std::max(kIdle * work, *rounding * rigid.norm()))
      direction.segment(first, size) -= rigid;
  }
}

/// Goes along the direction to a point that is better, and returns which part of it that took; 0 when there
/// was none.
double Newton::search_line(const Model& model, const IncrementalPotential& phi, const VecX& direction,
                           Point& point) const {
  const double slope = point.g.dot(direction);
  if (!(slope < 0.0)) return 0.0;
  // A decrease that drowns in the rounding of the energy is told by the residual instead.
  const bool blind = -slope < 10.0 * kEpsilon * point.value_scale;
  double step = max_step(model, phi, point.q, direction);
  const int backtracks = blind ? kMaxBlindBacktracks : kMaxBacktracks;
  for (int k = 0; k <= backtracks; ++k, step *= 0.5) {
    Point next = evaluate(model, phi, point.q + step * direction);
    if (!next.is_finite()) continue;
    const bool better = blind ? next.norm < (1.0 - kArmijo * step) * point.norm
                              : next.value <= point.value + kArmijo * step * slope;
    if (!better) continue;
    point = std::move(next);
    return step;
  }
  return 0.0;
}

/// What the rounding of q alone leaves of the residual. [N]
double Newton::rounding_floor(const VecX& q) const { return pins().free_norm(H_.rounding_of_times(q)); }

/// Goes along a direction in which the held coordinates reach q_held, as far as V is defined; Φ need not
/// fall. Returns which part of it that took; 0 when it got nowhere.
double Newton::carry(const Model& model, const IncrementalPotential& phi, const VecX& direction,
                     Point& point) const {
  double step = max_step(model, phi, point.q, direction);
  for (int k = 0; k <= kMaxBlindBacktracks; ++k, step *= 0.5) {
    VecX q = point.q + step * direction;
    if (step == 1.0)  // to the bit, whatever the sum rounds to
      for (int dof = 0; dof < q.size(); ++dof)
        if (pins().is_held(dof)) q[dof] = phi.q_held[dof];
    Point next = evaluate(model, phi, std::move(q));
    if (!next.is_finite()) continue;
    point = std::move(next);
    return step;
  }
  return 0.0;
}

NewtonReport Newton::minimize(const Model& model, const IncrementalPotential& phi, VecX& q) {
  const Pins* held = phi.pins != nullptr ? phi.pins : &model.pins();
  if (held != pins_) solver_.analyze(model.pattern(), *held);
  pins_ = held;
  try_at_rest(solver_, phi.m, model, pins(), {phi.m, phi.a}, H_);
  solver_.begin(phi.m, [&] { return vertex_rotations(model.mesh(), q); });
  has_fresh_hessian_ = false;
  NewtonReport report;
  const SolveCounts before = solver_.counts();
  const double farthest = kFarthest * (q.cwiseAbs().maxCoeff() + model.mesh().X.cwiseAbs().maxCoeff());
  Point point = evaluate(model, phi, std::exchange(q, {}));  // `end` gives it back
  const auto end = [&](StepStatus status) {
    report.status = status;
    report.residual = point.residual();
    report.solves = solver_.counts() - before;
    q = std::move(point.q);
    report.balance = std::move(point.balance);
    return report;
  };
  const auto end_stagnated = [&] {
    const bool at_floor = point.norm <= kNearRoundingFloor * rounding_floor(point.q);
    return end(at_floor ? StepStatus::rounding_floor : StepStatus::not_converged);
  };
  VecX direction, lift;  // what the held coordinates have still to go
  double clamping = 0.0;
  int carries = 0;
  double norm_before = 0.0;  // none yet
  const auto goal_of = [&](const Point& at, double before) {
    // No more of a system is solved than Newton's own error lets come true. [Eisenstat and Walker 1996,
    // choice 2]
    const double end = kPartOfTolerance * settings_.tolerance * at.reference / at.norm;
    const double quadratic = before > 0.0 ? std::pow(at.norm / before, 2) : kLoosest;
    return Goal{std::max(end, std::min(kLoosest, quadratic)), end};
  };
  report.iterates.push_back({point.residual(), point.value, 0.0, 0.0});
  for (;;) {
    if (!point.is_finite()) return end(StepStatus::not_finite);
    if (phi.q_held.size() != 0) lift = pins().pinned_part(phi.q_held - point.q);
    const bool arrived = lift.size() == 0 || lift.isZero(0.0);
    if (arrived && point.norm <= settings_.tolerance * point.reference) return end(StepStatus::converged);
    if (report.iterations == settings_.max_iterations)
      return arrived ? end_stagnated() : end(StepStatus::not_converged);

    const Goal goal = arrived ? goal_of(point, norm_before) : Goal{kWhileCarrying, kWhileCarrying};
    if (find_direction(model, phi, point, arrived ? VecX() : lift, goal, clamping, direction) !=
        FactorStatus::ok)
      return end(StepStatus::not_positive);
    ++report.iterations;
    if (!direction.allFinite()) return end(StepStatus::not_finite);
    if (!arrived) {
      const double part = ++carries > kMaxCarries ? 0.0 : carry(model, phi, direction, point);
      if (part == 0.0) return end(StepStatus::not_converged);
      report.iterates.push_back({point.residual(), point.value, part, used_clamping_});
      continue;
    }

    if (phi.m == 0.0) drop_idle_motion(model, point, direction);
    norm_before = point.norm;
    const double step = search_line(model, phi, direction, point);
    if (step == 0.0) return end_stagnated();
    // Nothing holds what falls without end.
    if (phi.m == 0.0 && point.q.cwiseAbs().maxCoeff() > farthest) return end(StepStatus::not_converged);
    report.iterates.push_back({point.residual(), point.value, step, used_clamping_});
    const bool crawls = point.norm > 0.5 * norm_before && point.norm > settings_.tolerance * point.reference;
    if (crawls && point.norm <= kNearRoundingFloor * rounding_floor(point.q))
      return end(StepStatus::rounding_floor);
  }
}

}  // namespace lagomorph::sim
