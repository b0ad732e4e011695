#pragma once

#include <vector>

#include "sim/io/scanner.h"
#include "sim/types.h"

namespace lagomorph::sim::io {

/// Appends the triangles of a polygon given by its corners in X: a fan from the first where the polygon is
/// convex, by cutting ears in the plane of its mean normal where it is not. Fails at what the scanner read
/// last when it has fewer than 3 corners or more than 1000.
void triangulate_polygon(const std::vector<int>& polygon, const Eigen::Map<const Points>& X,
                         std::vector<Triangle>& triangles, Scanner& scanner);

/// A view of x0 y0 z0 x1 ... as points.
inline Eigen::Map<const Points> as_points(const std::vector<double>& coordinates) {
  return {coordinates.data(), static_cast<Eigen::Index>(coordinates.size() / 3), 3};
}

}  // namespace lagomorph::sim::io
