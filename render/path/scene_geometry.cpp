#include "render/path/scene_geometry.h"

#include <algorithm>

namespace lagomorph::render::path {
namespace {

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

SurfacePoint surface_point(const Arrival& at) {
  return {vec3(at.origin), vec3(at.normal), vec3(at.beyond), at.inside, vec3(at.unbent)};
}

}  // namespace

SceneGeometry::SceneGeometry(const RenderScene& scene)
    : disc_{scene.ground.height, scene.ground.center.x(), scene.ground.center.z(),
            scene.ground.radius, scene.ground.fade_start, -1.0},
      segments_(scene.motion_segments) {
  meshes_.reserve(scene.meshes.size());
  for (const Mesh& m : scene.meshes) {
    meshes_.push_back({m.triangles,
                       m.positions,
                       {},
                       VertexNormals(m.triangles, m.positions.size()),
                       m.smooth,
                       true,
                       m.colors,
                       {},
                       {},
                       {}});
  }
  show_ground(scene.ground.enabled);
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
Vec3 SceneGeometry::position(const Moving& m, std::uint32_t vertex, float time) const {
  if (m.way.empty()) return m.positions[vertex];
  const TimeSegment at = time_segment(m.way.size(), time);
  const std::vector<Vec3>& next = at.step + 1 < m.way.size() ? m.way[at.step + 1] : m.positions;
  const Eigen::Vector3d a = m.way[at.step][vertex].cast<double>(), b = next[vertex].cast<double>();
  return (a + static_cast<double>(at.part) * (b - a)).cast<float>();
}

Corners SceneGeometry::corners(const Moving& m, const Triangle& triangle, float time) const {
  return {f3(position(m, triangle[0], time)), f3(position(m, triangle[1], time)),
          f3(position(m, triangle[2], time))};
}

Vec3 SceneGeometry::normal(const Moving& m, std::uint32_t vertex, float time) const {
  if (m.way_normals.empty()) return m.normals[vertex];
  const TimeSegment at = time_segment(m.way_normals.size(), time);
  const std::vector<Vec3>& next = at.step + 1 < m.way_normals.size() ? m.way_normals[at.step + 1] : m.normals;
  return ((1.0F - at.part) * m.way_normals[at.step][vertex] + at.part * next[vertex]).normalized();
}

Corners SceneGeometry::normals(const Moving& m, const Triangle& triangle, float time) const {
  if (!m.smooth) return {};
  return {f3(normal(m, triangle[0], time)), f3(normal(m, triangle[1], time)),
          f3(normal(m, triangle[2], time))};
}

void SceneGeometry::put_corners(const MeshHit& hit, float time, Meetings& meetings, std::size_t at) const {
  const Moving& m = meshes_[hit.mesh];
  const Triangle& triangle = m.triangles[hit.triangle];
  const Corners x = corners(m, triangle, time);
  meetings.a.set(at, x.a);
  meetings.b.set(at, x.b);
  meetings.c.set(at, x.c);
  if (!m.smooth) return;
  const Corners n = normals(m, triangle, time);
  meetings.normal_a.set(at, n.a);
  meetings.normal_b.set(at, n.b);
  meetings.normal_c.set(at, n.c);
}

TriangleHit SceneGeometry::meet(const Ray& ray, const MeshHit& hit) const {
  const Moving& m = meshes_[hit.mesh];
  return meet_triangle(f3(ray.origin), f3(ray.direction), corners(m, m.triangles[hit.triangle], ray.time));
}

SurfacePoint SceneGeometry::arrive(const Ray& ray, const MeshHit& hit, const TriangleHit& at) const {
  const Moving& m = meshes_[hit.mesh];
  const Triangle& triangle = m.triangles[hit.triangle];
  const Arrival to = arrive_on_triangle(-f3(ray.direction), at.u, at.v, corners(m, triangle, ray.time),
                                        normals(m, triangle, ray.time), m.smooth, disc_);
  return surface_point(to);
}

Vec3 SceneGeometry::behind(const Ray& ray, const MeshHit& hit, const TriangleHit& at) const {
  const Moving& m = meshes_[hit.mesh];
  const Corners x = corners(m, m.triangles[hit.triangle], ray.time);
  const Arrival to = arrive_on_triangle(-f3(ray.direction), at.u, at.v, x, {}, false, disc_);
  return vec3(to.beyond);
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
  return meet_disc(disc_, f3(ray.origin), f3(ray.direction));
}

Vec3 SceneGeometry::ground_point(const Ray& ray, double t) const {
  return vec3(point_on_disc(disc_, f3(ray.origin), f3(ray.direction), t));
}

SurfacePoint SceneGeometry::arrive_at_ground(const Ray& ray, double t) const {
  const F3 direction = f3(ray.direction);
  const Arrival to = arrive_on_disc(point_on_disc(disc_, f3(ray.origin), direction, t), direction);
  return surface_point(to);
}

}  // namespace lagomorph::render::path
