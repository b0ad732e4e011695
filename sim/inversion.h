#pragma once

#include "sim/types.h"

namespace lagomorph::sim {

/// Of the distance to where det(F + t dF) first reaches zero, the part that a step may go.
inline constexpr double kInversionMargin = 0.9;

/// Smallest t in (0, limit] with det(F + t dF) = 0, a cubic in t; +inf when there is none. det F must be
/// positive.
double first_inversion(const Mat3& F, const Mat3& dF, double limit);

/// Largest fraction in (0, 1] of dF that keeps det(F + t dF) > 0 with the margin.
double step_without_inversion(const Mat3& F, const Mat3& dF);

}  // namespace lagomorph::sim
