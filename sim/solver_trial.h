#pragma once

#include "sim/block_hessian.h"
#include "sim/model.h"
#include "sim/pins.h"
#include "sim/system_solver.h"

namespace lagomorph::sim {

/// A system's matrix, mass M + stiffness ∂²V/∂q².
struct SystemWeights {
  double mass, stiffness;
};

/// SystemSolver::try_at_rest() of minimizations with this m where the solver needs it, by what is there at
/// rest whatever has happened since, so that a run that is taken up again finds the same. `H` is overwritten.
void try_at_rest(SystemSolver&, double m, const Model&, const Pins&, const SystemWeights&, BlockHessian& H);

}  // namespace lagomorph::sim
