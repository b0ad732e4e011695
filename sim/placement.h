#pragma once

#include "sim/settings.h"
#include "sim/types.h"

namespace lagomorph::sim {

/// Rotation about the fixed x, then y, then z axis: R = Rz Ry Rx. Multiples of 90 degrees are exact.
Mat3 rotation_of(const Vec3& degrees);

/// X_world = translate + R (scale X_file), row by row.
void place(Points& X, const BodySettings&);

}  // namespace lagomorph::sim
