#pragma once

#include <limits>

#include "render/path/lane_math.h"
#include "render/render_scene.h"

/// The formulas of SceneGeometry for one lane; scene_geometry.h says what they mean.
namespace lagomorph::render::path {

struct D3 {
  double x, y, z;
};
LAGOMORPH_INLINE D3 d3(F3 a) { return {a.x, a.y, a.z}; }
LAGOMORPH_INLINE F3 f3(D3 a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}
LAGOMORPH_INLINE D3 operator-(D3 a, D3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
LAGOMORPH_INLINE D3 operator+(D3 a, D3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
LAGOMORPH_INLINE D3 operator*(double s, D3 a) { return {s * a.x, s * a.y, s * a.z}; }
LAGOMORPH_INLINE double dot(D3 a, D3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
LAGOMORPH_INLINE D3 cross(D3 a, D3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Where on its triangle a ray meets it: distance and barycentric coordinates, computed again from the
/// vertices in double precision, so that they do not depend on the hierarchy's instruction set.
struct TriangleHit {
  double t;     // [m]
  double u, v;  // weights of the second and third vertex
};

struct Corners {
  F3 a, b, c;
};

/// [Möller and Trumbore 1997]; edge-on to rounding it is the triangle's middle.
LAGOMORPH_INLINE TriangleHit meet_triangle(F3 origin, F3 direction, const Corners& at) {
  const D3 d = d3(direction);
  const D3 a = d3(at.a);
  const D3 e1 = d3(at.b) - a;
  const D3 e2 = d3(at.c) - a;
  const D3 s = d3(origin) - a;
  const D3 p = cross(d, e2);
  const double det = dot(e1, p);
  const D3 q = cross(s, e1);
  const double inv = 1.0 / det;
  const bool edge_on = det == 0.0;
  const double middle = dot((1.0 / 3.0) * (e1 + e2) - s, d);
  return {edge_on ? middle : dot(e2, q) * inv, edge_on ? 1.0 / 3.0 : dot(s, p) * inv,
          edge_on ? 1.0 / 3.0 : dot(d, q) * inv};
}

/// What of the ground rays can meet.
struct GroundDisc {
  float height, x, z, radius, fade_start;
  double met;  // radius^2; -1: there is no ground
};

/// Distance to the ground's disc, from either side; infinite where a ray misses it. A ray that begins on the
/// plane begins above it.
LAGOMORPH_INLINE double meet_disc(const GroundDisc& g, F3 origin, F3 direction) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const double above = static_cast<double>(origin.y) - g.height;
  const double climb = direction.y;
  const double t = -above / climb;
  const double x = origin.x + t * direction.x - g.x;
  const double z = origin.z + t * direction.z - g.z;
  const double within = x * x + z * z <= g.met ? t : never;
  return above >= 0.0 ? (climb < 0.0 ? within : never) : (climb > 0.0 ? within : never);
}

/// Point of the ground's plane at a distance.
LAGOMORPH_INLINE F3 point_on_disc(const GroundDisc& g, F3 origin, F3 direction, double t) {
  return {static_cast<float>(origin.x + t * direction.x), g.height,
          static_cast<float>(origin.z + t * direction.z)};
}

/// As ground_fade().
LAGOMORPH_INLINE float fade_of_disc(const GroundDisc& g, F3 point) {
  const float dx = point.x - g.x;
  const float dz = point.z - g.z;
  return fade_at(std::sqrt(dx * dx + dz * dz), g.fade_start, g.radius);
}

/// n bent as little as needed for the unit direction wo to be above it.
LAGOMORPH_INLINE F3 facing(F3 n, F3 wo) {
  constexpr float least = 1e-3F;
  const float cosine = dot(n, wo);
  return select(cosine >= least, n, normalized(n + (least - cosine) * wo));
}

LAGOMORPH_INLINE F3 offset_along(F3 p, F3 n) {
  return {offset_along(p.x, n.x), offset_along(p.y, n.y), offset_along(p.z, n.z)};
}

/// The point on the smooth surface that the vertex normals stand for: p is projected onto the three tangent
/// planes where it lies below them, the projections are interpolated and p is moved half of the way there
/// [Hanika 2021, "Hacking the Shadow Terminator"; he goes all of it]. Half is the sphere itself where the
/// vertices lie on one. Rays that start there do not meet the facets of a convex surface whose normals they
/// still pass. `side`: of the normals.
LAGOMORPH_INLINE F3 smooth_point(F3 p, const Corners& x, const Corners& n, F3 weight, float side) {
  const float a = std::min(0.0F, side * dot(p - x.a, n.a));
  const float b = std::min(0.0F, side * dot(p - x.b, n.b));
  const float c = std::min(0.0F, side * dot(p - x.c, n.c));
  return p - (0.5F * side) * (weight.x * a * n.a + weight.y * b * n.b + weight.z * c * n.c);
}

/// As SurfacePoint.
struct Arrival {
  F3 origin, normal, beyond;
  bool inside;
  F3 unbent;
};

/// `n`: unit normals of the vertices, of a `smooth` mesh. wo: where the ray came from.
LAGOMORPH_INLINE Arrival arrive_on_triangle(F3 wo, double u, double v, const Corners& x, const Corners& n,
                                            bool smooth, const GroundDisc& ground) {
  const D3 e1 = d3(x.b - x.a);
  const D3 e2 = d3(x.c - x.a);
  const F3 p = f3(d3(x.a) + (u * e1 + v * e2));
  const D3 across = cross(e1, e2);
  const double area = std::sqrt(dot(across, across));
  const F3 outer = f3((1.0 / std::max(area, 1e-300)) * across);
  const bool inside = dot(outer, wo) < 0.0F;
  const float side = inside ? -1.0F : 1.0F;
  const F3 flat = side * outer;
  const F3 weight = {static_cast<float>(1.0 - u - v), static_cast<float>(u), static_cast<float>(v)};
  const F3 sum = side * (weight.x * n.a + weight.y * n.b + weight.z * n.c);
  const float length = std::sqrt(dot(sum, sum));
  const bool bent = all_of(smooth, length > 0.0F, dot(sum, flat) > 0.0F);
  const F3 shading = select(bent, (1.0F / std::max(length, 1e-30F)) * sum, flat);
  const F3 start = select(bent, smooth_point(p, x, n, weight, side), p);
  const F3 start_beyond = select(bent, smooth_point(p, x, n, weight, -side), p);
  F3 origin = offset_along(start, flat);
  F3 beyond = offset_along(start_beyond, -flat);
  // A body that stands on the ground is not lit through it.
  const bool stands = all_of(ground.met >= 0.0, p.y >= ground.height);
  origin.y = stands ? std::max(origin.y, ground.height) : origin.y;
  beyond.y = stands ? std::max(beyond.y, ground.height) : beyond.y;
  return {origin, facing(shading, wo), beyond, inside, shading};
}

/// `direction`: of the ray.
LAGOMORPH_INLINE Arrival arrive_on_disc(F3 point, F3 direction) {
  const F3 normal = {0.0F, direction.y < 0.0F ? 1.0F : -1.0F, 0.0F};
  const F3 none = {0.0F, 0.0F, 0.0F};
  return {offset_along(point, normal), facing(normal, -direction), none, false, normal};
}

}  // namespace lagomorph::render::path
