#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/linear_solver.h"  // linear_algebra_info(), for run.json
#include "sim/model.h"
#include "sim/settings.h"

namespace lagomorph::sim {

enum class StepStatus {
  converged,       // |g_free| met the tolerance
  rounding_floor,  // stagnated within 10 times of what rounding lets the residual reach: converged, and told
  not_converged,   // iterations ran out, or stagnation above the floor
  not_positive,    // no positive definite system could be had
  not_finite,      // NaN or infinity
};
std::string_view to_string(StepStatus);
inline bool is_good(StepStatus s) { return s == StepStatus::converged || s == StepStatus::rounding_floor; }

/// What one step did.
struct StepReport {
  StepStatus status = StepStatus::converged;
  int newton_iterations = 0;
  double residual = 0.0;  // |g_free| / |(M g)_free|, as the tolerance is measured
  double h = 0.0;         // step [s]
  int steps = 1;          // that an explicit scheme had to divide it into to stay stable
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
  /// q(t) -> q(t + h). On a bad status the state is left as it was.
  virtual StepReport step(const Model&, State&, double h) = 0;
};

std::vector<std::string> integrator_names();
/// Throws InputError for an unknown name, listing the valid ones.
std::unique_ptr<Integrator> make_integrator(const TimeSettings&, const SolverSettings&, const Model&);

/// What one frame did: the worst of its steps.
struct FrameReport {
  StepStatus status = StepStatus::converged;
  int steps = 0;              // taken, halved ones counted singly
  int halvings = 0;           // how deep a step had to be halved
  int newton_iterations = 0;  // sum over the steps
  double residual = 0.0;      // largest
  bool hit_rounding_floor = false;
  std::vector<Vec3> pin_forces = {};  // of each pin of the scene, in the last step [N]
  double work_pins = 0.0;             // sum over the steps [J]
  double work_loads = 0.0;            // likewise
  std::string reason;                 // one line, when status is not good
};

/// Advances the state from its frame to the next, at exactly t = (frame + 1) / fps, by `substeps` steps; a
/// step that does not converge is halved up to `max_halvings` times. On a bad status the state is left at its
/// frame.
FrameReport advance_frame(const Model&, Integrator&, const TimeSettings&, const SolverSettings&, State&);

}  // namespace lagomorph::sim
