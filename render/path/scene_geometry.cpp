#include "render/path/scene_geometry.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace lagomorph::render::path {
namespace {

/// The point on the smooth surface that the vertex normals stand for: p is projected onto the three tangent
/// planes where it lies below them, the projections are interpolated and p is moved half of the way there
/// [Hanika 2021, "Hacking the Shadow Terminator"; he goes all of it]. Half is the sphere itself where the
/// vertices lie on one. Rays that start there do not meet the facets of a convex surface whose normals they
/// still pass.
Vec3 smooth_point(const Vec3& p, const Vec3 (&x)[3], const Vec3 (&n)[3], const float (&weight)[3]) {
  Vec3 raised = p;
  for (int k = 0; k < 3; ++k) {
    const float below = std::min(0.0F, (p - x[k]).dot(n[k]));
    raised -= 0.5F * weight[k] * below * n[k];
  }
  return raised;
}

Vec3 interpolated(const std::vector<Vec3>& x, const Triangle& triangle, double u, double v) {
  const Eigen::Vector3d a = x[triangle[0]].cast<double>();
  const Eigen::Vector3d b = x[triangle[1]].cast<double>();
  const Eigen::Vector3d c = x[triangle[2]].cast<double>();
  return (a + u * (b - a) + v * (c - a)).cast<float>();
}

/// A time among equidistant time steps, as Embree takes it: `part` of the way from a step to the next.
struct TimeSegment {
  std::size_t step;
  float part;
};
TimeSegment time_segment(std::size_t segments, float time) {
  const float along = time * static_cast<float>(segments);
  const std::size_t step = std::min(static_cast<std::size_t>(along), segments - 1);
  return {step, along - static_cast<float>(step)};
}

/// n bent as little as needed for the unit direction wo to be above it.
Vec3 facing(const Vec3& n, const Vec3& wo) {
  constexpr float least = 1e-3F;
  const float cosine = n.dot(wo);
  return cosine >= least ? n : Vec3((n + (least - cosine) * wo).normalized());
}

}  // namespace

SceneGeometry::SceneGeometry(const RenderScene& scene)
    : ground_(scene.ground), segments_(scene.motion_segments) {
  meshes_.reserve(scene.meshes.size());
  for (const Mesh& m : scene.meshes) {
    meshes_.push_back({m.triangles,
                       m.positions,
                       {},
                       VertexNormals(m.triangles, m.positions.size()),
                       m.smooth,
                       true,
                       m.material.transmission > 0.0F || m.material.subsurface > 0.0F,
                       m.colors,
                       {},
                       {},
                       {}});
  }
  caster_.build(scene.meshes, segments_);
}

void SceneGeometry::move(int mesh, std::span<const Vec3> positions) {
  Moving& m = meshes_[static_cast<std::size_t>(mesh)];
  std::copy(positions.begin(), positions.end(), m.positions.begin());
  m.moved = true;
  m.way.clear();
  m.way_normals.clear();
  m.previous.clear();
}

void SceneGeometry::set_previous(int mesh, std::span<const Vec3> positions) {
  meshes_[static_cast<std::size_t>(mesh)].previous.assign(positions.begin(), positions.end());
}

void SceneGeometry::set_motion(int mesh, std::span<const std::vector<Vec3>> positions) {
  Moving& m = meshes_[static_cast<std::size_t>(mesh)];
  m.way.assign(positions.begin(), positions.end());
  m.moved = true;
}

void SceneGeometry::color(int mesh, std::span<const Color> colors) {
  meshes_[static_cast<std::size_t>(mesh)].colors.assign(colors.begin(), colors.end());
}

void SceneGeometry::commit() {
  bool any = false;
  for (std::size_t i = 0; i < meshes_.size(); ++i) {
    Moving& m = meshes_[i];
    if (!m.moved) continue;
    m.moved = false;
    any = true;
    if (m.smooth) m.topology.compute(m.triangles, m.positions, m.normals);
    m.way_normals.resize(m.smooth ? m.way.size() : 0);
    for (std::size_t step = 0; step < m.way_normals.size(); ++step)
      m.topology.compute(m.triangles, m.way[step], m.way_normals[step]);
    caster_.move(static_cast<int>(i), m.positions);
    for (int step = 0; step < segments_; ++step) {
      caster_.move_at(step, static_cast<int>(i),
                      m.way.empty() ? m.positions : m.way[static_cast<std::size_t>(step)]);
    }
  }
  if (any) caster_.commit();
}

/// Straight between time steps.
Eigen::Vector3d SceneGeometry::position(const Moving& m, std::uint32_t vertex, float time) const {
  if (m.way.empty()) return m.positions[vertex].cast<double>();
  const TimeSegment at = time_segment(m.way.size(), time);
  const std::vector<Vec3>& next = at.step + 1 < m.way.size() ? m.way[at.step + 1] : m.positions;
  const Eigen::Vector3d a = m.way[at.step][vertex].cast<double>(), b = next[vertex].cast<double>();
  return a + static_cast<double>(at.part) * (b - a);
}

Vec3 SceneGeometry::normal(const Moving& m, std::uint32_t vertex, float time) const {
  if (m.way_normals.empty()) return m.normals[vertex];
  const TimeSegment at = time_segment(m.way_normals.size(), time);
  const std::vector<Vec3>& next = at.step + 1 < m.way_normals.size() ? m.way_normals[at.step + 1] : m.normals;
  return ((1.0F - at.part) * m.way_normals[at.step][vertex] + at.part * next[vertex]).normalized();
}

SceneGeometry::TriangleHit SceneGeometry::meet(const Ray& ray, const MeshHit& hit) const {
  // [Möller and Trumbore 1997]
  const Moving& m = meshes_[hit.mesh];
  const Triangle& triangle = m.triangles[hit.triangle];
  const Eigen::Vector3d d = ray.direction.cast<double>();
  const Eigen::Vector3d a = position(m, triangle[0], ray.time);
  const Eigen::Vector3d e1 = position(m, triangle[1], ray.time) - a;
  const Eigen::Vector3d e2 = position(m, triangle[2], ray.time) - a;
  const Eigen::Vector3d s = ray.origin.cast<double>() - a;
  const Eigen::Vector3d p = d.cross(e2);
  const double det = e1.dot(p);
  if (det == 0.0)
    return {((e1 + e2) / 3.0 - s).dot(d), 1.0 / 3.0, 1.0 / 3.0};  // edge-on to rounding: its middle
  const Eigen::Vector3d q = s.cross(e1);
  const double inv = 1.0 / det;
  return {e2.dot(q) * inv, s.dot(p) * inv, d.dot(q) * inv};
}

SurfacePoint SceneGeometry::arrive(const Ray& ray, const MeshHit& hit, const TriangleHit& at) const {
  const Moving& m = meshes_[hit.mesh];
  const Triangle& triangle = m.triangles[hit.triangle];
  const Vec3 x[3] = {position(m, triangle[0], ray.time).cast<float>(),
                     position(m, triangle[1], ray.time).cast<float>(),
                     position(m, triangle[2], ray.time).cast<float>()};
  const Vec3 wo = -ray.direction;
  const Eigen::Vector3d e1 = (x[1] - x[0]).cast<double>();
  const Eigen::Vector3d e2 = (x[2] - x[0]).cast<double>();
  const Vec3 p = (x[0].cast<double>() + at.u * e1 + at.v * e2).cast<float>();
  Vec3 flat = e1.cross(e2).normalized().cast<float>();
  const float side = flat.dot(wo) < 0.0F ? -1.0F : 1.0F;
  flat *= side;

  Vec3 shading = flat;
  Vec3 start = p;
  Vec3 start_beyond = p;
  if (m.smooth) {
    const Vec3 n[3] = {side * normal(m, triangle[0], ray.time), side * normal(m, triangle[1], ray.time),
                       side * normal(m, triangle[2], ray.time)};
    const float weight[3] = {static_cast<float>(1.0 - at.u - at.v), static_cast<float>(at.u),
                             static_cast<float>(at.v)};
    const Vec3 sum = weight[0] * n[0] + weight[1] * n[1] + weight[2] * n[2];
    const float length = sum.norm();
    if (length > 0.0F && sum.dot(flat) > 0.0F) {
      shading = sum / length;
      start = smooth_point(p, x, n, weight);
      if (m.has_inside) {
        const Vec3 back[3] = {-n[0], -n[1], -n[2]};
        start_beyond = smooth_point(p, x, back, weight);
      }
    }
  }
  Vec3 origin = offset_along(start, flat);
  // A body that stands on the ground is not lit through it.
  Vec3 beyond = offset_along(start_beyond, -flat);
  if (ground_.enabled && p.y() >= ground_.height) {
    origin.y() = std::max(origin.y(), ground_.height);
    beyond.y() = std::max(beyond.y(), ground_.height);
  }
  return {origin, facing(shading, wo), beyond, side < 0.0F, shading};
}

Vec3 SceneGeometry::behind(const Ray& ray, const MeshHit& hit, const TriangleHit& at) const {
  const Moving& m = meshes_[hit.mesh];
  const Triangle& triangle = m.triangles[hit.triangle];
  const Eigen::Vector3d a = position(m, triangle[0], ray.time);
  const Eigen::Vector3d e1 = position(m, triangle[1], ray.time) - a;
  const Eigen::Vector3d e2 = position(m, triangle[2], ray.time) - a;
  const Vec3 flat = e1.cross(e2).normalized().cast<float>();
  const Vec3 p = (a + at.u * e1 + at.v * e2).cast<float>();
  return offset_along(p, flat.dot(ray.direction) < 0.0F ? Vec3(-flat) : flat);
}

Vec3 SceneGeometry::position_at(const MeshHit& hit, const TriangleHit& at) const {
  const Moving& m = meshes_[hit.mesh];
  return interpolated(m.positions, m.triangles[hit.triangle], at.u, at.v);
}

Vec3 SceneGeometry::previous_at(const MeshHit& hit, const TriangleHit& at) const {
  const Moving& m = meshes_[hit.mesh];
  return interpolated(m.previous.empty() ? m.positions : m.previous, m.triangles[hit.triangle], at.u, at.v);
}

std::optional<Color> SceneGeometry::color_at(const MeshHit& hit, const TriangleHit& at) const {
  const Moving& m = meshes_[hit.mesh];
  if (m.colors.empty()) return std::nullopt;
  const Triangle& triangle = m.triangles[hit.triangle];
  const auto u = static_cast<float>(at.u), v = static_cast<float>(at.v);
  const Color color =
      (1.0F - u - v) * m.colors[triangle[0]] + u * m.colors[triangle[1]] + v * m.colors[triangle[2]];
  return Color(color.max(0.0F).min(1.0F));
}

double SceneGeometry::meet_ground(const Ray& ray) const {
  if (!ground_.enabled) return never;
  const double above = static_cast<double>(ray.origin.y()) - ground_.height;
  const double climb = ray.direction.y();
  // A ray that begins on the plane begins above it.
  if (above >= 0.0 ? climb >= 0.0 : climb <= 0.0) return never;
  const double t = -above / climb;
  const double x = ray.origin.x() + t * ray.direction.x() - ground_.center.x();
  const double z = ray.origin.z() + t * ray.direction.z() - ground_.center.z();
  return x * x + z * z <= static_cast<double>(ground_.radius) * ground_.radius ? t : never;
}

Vec3 SceneGeometry::ground_point(const Ray& ray, double t) const {
  return {static_cast<float>(ray.origin.x() + t * ray.direction.x()), ground_.height,
          static_cast<float>(ray.origin.z() + t * ray.direction.z())};
}

SurfacePoint SceneGeometry::arrive_at_ground(const Ray& ray, double t) const {
  const Vec3 normal(0.0F, ray.direction.y() < 0.0F ? 1.0F : -1.0F, 0.0F);
  return {offset_along(ground_point(ray, t), normal), facing(normal, -ray.direction), Vec3::Zero(), false,
          normal};
}

Vec3 offset_along(const Vec3& p, const Vec3& n) {
  Vec3 moved;
  for (int k = 0; k < 3; ++k) {
    const auto steps = static_cast<std::int32_t>(256.0F * n[k]);
    const auto bits = std::bit_cast<std::int32_t>(p[k]);
    const float by_bits = std::bit_cast<float>(bits + (p[k] < 0.0F ? -steps : steps));
    moved[k] = std::abs(p[k]) < 1.0F / 32.0F ? p[k] + n[k] / 65536.0F : by_bits;
  }
  return moved;
}

}  // namespace lagomorph::render::path
