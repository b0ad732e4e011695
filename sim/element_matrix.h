#pragma once

#include "sim/kinematics.h"

namespace lagomorph::sim {

/// The rows of D = ∂φ/∂X of all nodes but the first, (N-1)×3 [1/m]; the first is minus their sum.
template <int N>
using InnerGradients = Eigen::Matrix<double, N - 1, 3>;

/// Adds the blocks a, b >= 1 of the upper triangle of Bᵀ h B, with h 9×9 over row-major vec(F), to `blocks`,
/// 3×3 each, column by column, in TetGather's order of pairs.
template <int N>
void add_inner_blocks(const Mat9& h, const InnerGradients<N>& D, double* blocks);

/// The blocks of the first node from all the others: as the rows of D sum to zero, so do the blocks' rows.
template <int N>
void complete_blocks(double* blocks);

}  // namespace lagomorph::sim
