#pragma once

#include <optional>

#include "sim/block_hessian.h"
#include "sim/integrator.h"
#include "sim/model.h"
#include "sim/settings.h"
#include "sim/solve_counts.h"
#include "sim/system_solver.h"

namespace lagomorph::sim {

/// Φ(q) = m/2 (q - q̃)ᵀM(q - q̃) + V(a q + b)/a - fᵀq, whose minimum over the free vertices is the end of an
/// implicit step: ∂Φ/∂q = 0 is m M (q - q̃) = -∂V/∂q (a q + b) + f, a balance of forces. With m = 0, a = 1 it
/// is V itself and its minimum an equilibrium.
struct IncrementalPotential {
  double m = 0.0;    // 1/h² for backward Euler [1/s²]
  VecX q_predicted;  // q̃, 3n [m]
  double a = 1.0;  // where V is evaluated: the end of the step for a = 1, its middle for a = 1/2 and b = q/2
  VecX b;          // 3n [m]; empty: zero
  VecX f;          // constant force, 3n [N]; empty: zero
  const Pins* pins = nullptr;  // what is held; none: the model's at the start. Must outlive the Newton
  VecX q_held;                 // where the held coordinates end, 3n [m]; empty: where they are
  // Damping: + c/2 (q - q_still)ᵀ C (q - q_still).
  const BlockHessian* C = nullptr;  // [kg/s]; nullptr: none
  double c = 0.0;                   // [1/s]
  VecX q_still;                     // where the scheme's q̇ is zero, 3n [m]
};

/// Within this many rounding floors, stagnation is convergence.
inline constexpr double kNearRoundingFloor = 10.0;

/// Throws InputError for a value out of range.
void check(const SolverSettings&);

struct NewtonReport {
  StepStatus status = StepStatus::converged;
  int iterations = 0;     // linear systems solved
  double residual = 0.0;  // |g_free| over the reference
  VecX balance;  // ∂Φ/∂q, 3n: zero but for the residual where free, the force of the pins where held [N]
  std::vector<NewtonIterate> iterates;
  SolveCounts solves;
};

/// Newton's method with a line search. Keeps the symbolic factorization and buffers of one model's topology.
class Newton {
public:
  Newton(const Model&, const SolverSettings&);
  /// Minimizes Φ over the free coordinates from q on. The held ones move to q_held, and the free ones with
  /// them by Newton's own direction for held ones that move, in as many pieces as keep V defined. On a bad
  /// status q is where it gave up.
  NewtonReport minimize(const Model&, const IncrementalPotential&, VecX& q);

private:
  struct Point;
  Point evaluate(const Model&, const IncrementalPotential&, VecX q) const;
  void assemble(const Model&, const IncrementalPotential&, const VecX& q, HessianKind, BlockHessian& H) const;
  struct Goal;
  FactorStatus find_direction(const Model&, const IncrementalPotential&, const Point&, const VecX& lift,
                              const Goal&, double& clamping, VecX& direction);
  template <class Solve>
  FactorStatus solve_shifted(const Model&, Solve&&);
  void drop_idle_motion(const Model&, const Point&, VecX& direction) const;
  double search_line(const Model&, const IncrementalPotential&, const VecX& direction, Point& point) const;
  double carry(const Model&, const IncrementalPotential&, const VecX& direction, Point& point) const;
  double rounding_floor(const VecX& q) const;
  const Pins& pins() const { return *pins_; }

  SolverSettings settings_;
  SystemSolver solver_;
  const Pins* pins_;                               // that it is analyzed for
  BlockHessian H_;                                 // as it was solved with last
  std::optional<BlockHessian> exact_, projected_;  // made where H_ is not positive definite
  bool has_fresh_hessian_ = false;                 // H_ is of the iteration before
  double used_clamping_ = 0.0;                     // of H_
};

}  // namespace lagomorph::sim
