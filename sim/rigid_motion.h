#pragma once

#include "sim/types.h"

namespace lagomorph::sim {

/// What of the displacements `dq` (3n, [m]) of vertices at `q` moves them as a rigid body would to first
/// order: t + ω × (x - c), the nearest such field in the sum of squares. 3n.
VecX rigid_part(const Eigen::Ref<const VecX>& q, const Eigen::Ref<const VecX>& dq);

}  // namespace lagomorph::sim
