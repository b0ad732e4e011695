#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/linear_solver.h"  // linear_algebra_info(), for run.json
#include "sim/model.h"
#include "sim/settings.h"
#include "sim/solve_counts.h"

namespace lagomorph::sim {

enum class StepStatus {
  converged,       // |g_free| met the tolerance
  rounding_floor,  // stagnated within 10 times of what rounding lets the residual reach: converged, and told
  not_converged,   // iterations ran out, or stagnation above the floor
  not_positive,    // no positive definite system could be had
  not_finite,      // NaN or infinity
  inaccurate,      // solved, but the estimated error is over time.error_tolerance
};
std::string_view to_string(StepStatus);
StepStatus step_status(std::string_view);  // the same back; throws InputError for another word
inline bool is_good(StepStatus s) { return s == StepStatus::converged || s == StepStatus::rounding_floor; }

/// A point that Newton's method came to.
struct NewtonIterate {
  double residual = 0.0;  // |g_free| over the reference
  double energy = 0.0;    // Φ, what is minimized [J]
  double step = 0.0;      // part of Newton's step that led here; 0 at the first guess
  double clamping = 0.0;  // of the Hessian that led here: 0 exact, 1 projected, a blend between
};

/// What one step did.
struct StepReport {
  StepStatus status = StepStatus::converged;
  int newton_iterations = 0;
  double residual = 0.0;  // |g_free| / |(M g)_free|, as the tolerance is measured
  double h = 0.0;         // step [s]
  int steps = 1;          // that an explicit scheme had to divide it into to stay stable
  std::vector<NewtonIterate> iterates = {};
  SolveCounts solves = {};
  double damping_loss = 0.0;  // that damping has turned into heat, >= 0 [J]
  std::optional<double> error =
      {};  // estimate, of the positions at the end [m]; none: a step alone does not tell
  std::vector<Vec3> pin_forces =
      {};                   // of each pin of the scene on the bodies, in the balance of the step [N]
  double work_pins = 0.0;   // of these forces over the step [J]
  double work_loads = 0.0;  // of the dead loads [J]

  /// Takes the forces in, and adds the works, of a step by dq. `balance` is what the scheme's inertia, ∂V/∂q
  /// and loads leave, 3n: the force of the pins where held. `load` is empty when there is none. [N]
  void account(const Held&, const VecX& balance, const VecX& load, const VecX& dq);
};

/// An implicit (or explicit) scheme. Holds no state of the motion: only factors and buffers that are made
/// again.
class Integrator {
public:
  virtual ~Integrator() = default;
  virtual std::string_view name() const = 0;
  virtual int history_levels() const = 0;  // levels beyond the current one that a State must carry
  /// How the reason of a failure begins.
  virtual const char* step_name() const { return "a step"; }
  virtual State initial_state(const Model& model) const { return model.initial_state(); }
  /// q(t) -> q(t + h). On a bad status the state is left as it was.
  virtual StepReport step(const Model&, State&, double h) = 0;
};

std::vector<std::string> integrator_names();
/// Throws InputError for an unknown name, listing the valid ones.
std::unique_ptr<Integrator> make_integrator(const TimeSettings&, const SolverSettings&, const Model&);

/// How a step was solved, or was not.
struct NewtonLog {
  double t = 0.0, h = 0.0;  // where it began, and its length [s]
  StepStatus status = StepStatus::converged;
  std::vector<NewtonIterate> iterates;  // the first guess first
};

/// What one frame did: the worst of its steps.
struct FrameReport {
  StepStatus status = StepStatus::converged;
  int steps = 0;              // taken, halved ones counted singly
  int rejected = 0;           // steps tried and halved
  int halvings = 0;           // how deep a step had to be halved
  int newton_iterations = 0;  // sum over the steps
  SolveCounts solves = {};    // likewise
  double residual = 0.0;      // largest
  double damping_loss = 0.0;  // sum over the steps, >= 0 [J]
  double error = 0.0;         // largest estimate of a step, with time.error_tolerance [m]
  bool hit_rounding_floor = false;
  std::vector<NewtonLog> newton;      // of every step tried, in order
  std::vector<Vec3> pin_forces = {};  // of each pin of the scene, in the last step [N]
  double work_pins = 0.0;             // sum over the steps [J]
  double work_loads = 0.0;            // likewise
  std::string reason;                 // one line, when status is not good
};

/// Advances the state from its frame to the next, at exactly t = (frame + 1) / fps, by `substeps` steps; a
/// step that does not converge, or whose estimated error is over `error_tolerance`, is halved up to
/// `max_halvings` times. Halves of halves: which steps are tried depends on the state alone, and BDF2 keeps
/// its history while neighbours are equally long. Schemes that do not estimate the error of a step themselves
/// take it twice, whole and in halves; a third of the difference is the error of the halves, which are kept.
/// [Hairer, Nørsett and Wanner 1993, Sec. II.4] On a bad status the state is left at its
/// frame.
FrameReport advance_frame(const Model&, Integrator&, const TimeSettings&, const SolverSettings&, State&);

}  // namespace lagomorph::sim
