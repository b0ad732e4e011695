#pragma once

#include "sim/model.h"

namespace lagomorph::bench {

/// Backward Euler as a course implements it from the lecture, the baseline that our own step is measured by:
/// Newton's method with B, K_j = vol_j B_jᵀ (∂²ψ/∂F²) B_j tet by tet, triplets into a sparse matrix, pinned
/// rows dropped by P, Eigen's SimplicialLDLT analysed and factorized anew in each iteration, and a
/// backtracking line search. On one thread. Of stable_neo_hookean alone, with consistent mass. Stops at the
/// same |g_free| <= tolerance |(M g)_free|. Returns the iterations; 0 when it did not converge.
int course_step(const sim::Model&, double mu, double lambda, double tolerance, double h, sim::State&);

}  // namespace lagomorph::bench
