#pragma once

#include "sim/newton.h"

namespace lagomorph::sim {

/// Moves the free vertices from q on to a minimum of V, a stable equilibrium: ∂V/∂q_free = 0. `tolerance`,
/// `max_iterations` and `hessian` of the settings hold as in a step. On a bad status q is where it gave up.
NewtonReport static_equilibrium(const Model&, const SolverSettings&, VecX& q);

}  // namespace lagomorph::sim
