#include "sim/io/polygon.h"

#include <cstddef>

#include <Eigen/Geometry>

namespace lagomorph::sim::io {
namespace {

using PointsView = Eigen::Map<const Points>;

Vec3 corner_normal(const PointsView& X, int a, int b, int c) {
  const Vec3 A = X.row(a), B = X.row(b), C = X.row(c);
  return (B - A).cross(C - A);
}

/// Newell's normal of a polygon, twice its area long.
Vec3 polygon_normal(const std::vector<int>& polygon, const PointsView& X) {
  Vec3 normal = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    normal += corner_normal(X, polygon[0], polygon[i], polygon[i + 1]);
  return normal;
}

/// Whether the corner at i can be cut off: it is convex and no other corner lies in its triangle.
bool is_ear(const std::vector<int>& polygon, std::size_t i, const PointsView& X, const Vec3& normal) {
  const std::size_t n = polygon.size();
  const std::size_t before = (i + n - 1) % n;
  const std::size_t after = (i + 1) % n;
  const int a = polygon[before], b = polygon[i], c = polygon[after];
  if (corner_normal(X, a, b, c).dot(normal) <= 0.0) return false;
  for (std::size_t k = 0; k < n; ++k) {
    const int p = polygon[k];
    if (k == before || k == i || k == after || p == a || p == b || p == c) continue;
    if (corner_normal(X, a, b, p).dot(normal) >= 0.0 && corner_normal(X, b, c, p).dot(normal) >= 0.0 &&
        corner_normal(X, c, a, p).dot(normal) >= 0.0) {
      return false;
    }
  }
  return true;
}

}  // namespace

void triangulate_polygon(const std::vector<int>& polygon, const PointsView& X,
                         std::vector<Triangle>& triangles, Scanner& scanner) {
  if (polygon.size() < 3 || polygon.size() > 1000) {
    scanner.fail("a face of " + std::to_string(polygon.size()) + " corners; it must have 3 to 1000");
  }
  const Vec3 normal = polygon_normal(polygon, X);
  std::vector<int> rest = polygon;
  while (rest.size() > 3) {
    // From the second corner on, so that a convex polygon becomes a fan from its first. A polygon that
    // crosses itself has no ear at some time; its second corner goes all the same.
    std::size_t ear = 1;
    while (ear <= rest.size() && !is_ear(rest, ear % rest.size(), X, normal)) ++ear;
    if (ear > rest.size()) ear = 1;
    const std::size_t n = rest.size();
    triangles.push_back({rest[(ear + n - 1) % n], rest[ear % n], rest[(ear + 1) % n]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear % n));
  }
  triangles.push_back({rest[0], rest[1], rest[2]});
}

}  // namespace lagomorph::sim::io
