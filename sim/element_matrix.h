#pragma once

#include "sim/kinematics.h"

namespace lagomorph::sim {

/// The upper triangle of Bᵀ h B, with h 9×9 over row-major vec(F), in TetGather's order of pairs: ten 3×3
/// blocks, column by column. `D123` are the rows of D of the last three corners; the first is minus their
/// sum, so its blocks are minus sums of the others'.
void element_blocks(const Mat9& h, const Mat3& D123, double* blocks);

}  // namespace lagomorph::sim
