#include "render/path/seen_channels.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace lagomorph::render::path {
namespace {

/// What a ray meets.
struct Seen {
  double t = SceneGeometry::never;
  float mesh = -1.0F;  // its body's number
  float triangle = -1.0F;
  Vec3 normal = Vec3::Zero();
  Color albedo = Color::Zero();
  Vec3 position = Vec3::Zero();
  Vec3 before = Vec3::Zero();  // where it was at the frame before
};

Seen seen_by(const SeenScene& scene, const Ray& ray, const MeshHit& hit) {
  Seen seen;
  const double to_ground = scene.geometry.meet_ground(ray);
  if (hit.mesh != MeshHit::none) {
    const TriangleHit at = scene.geometry.meet(ray, hit);
    if (at.t <= to_ground) {
      seen.t = at.t;
      seen.mesh = static_cast<float>(scene.meshes[hit.mesh].body_id);
      seen.triangle = static_cast<float>(hit.triangle);
      seen.normal = scene.geometry.arrive(ray, hit, at).unbent;
      seen.albedo = scene.geometry.color_at(hit, at).value_or(scene.shading.albedos[hit.mesh]);
      seen.position = scene.geometry.position_at(hit, at);
      seen.before = scene.geometry.previous_at(hit, at);
      return seen;
    }
  }
  if (to_ground < SceneGeometry::never) {
    seen.t = to_ground;
    seen.normal = Vec3(0.0F, ray.direction.y() < 0.0F ? 1.0F : -1.0F, 0.0F);
    seen.position = seen.before = scene.geometry.ground_point(ray, to_ground);
    seen.albedo = scene.shading.textured_ground(seen.position).value_or(scene.shading.albedos.back());
  }
  return seen;
}

void put(float* channel, std::size_t pixel, const Vec3& value) {
  if (channel != nullptr) std::copy_n(value.data(), 3, channel + 3 * pixel);
}

void write(const SeenScene& scene, const SeenChannels& to, std::size_t pixel, const Ray& ray,
           const Seen& seen) {
  const bool nothing = seen.t == SceneGeometry::never;
  if (to.depth != nullptr) to.depth[pixel] = scene.camera.depth(ray, seen.t);
  if (to.body_id != nullptr) to.body_id[pixel] = seen.mesh;
  if (to.triangle_id != nullptr) to.triangle_id[pixel] = seen.triangle;
  put(to.normal, pixel, seen.normal);
  put(to.albedo, pixel, seen.albedo.matrix());
  put(to.position, pixel, seen.position);
  if (to.motion != nullptr && !nothing) {
    const Vec2 motion = scene.camera.project(seen.position) - scene.camera_before.project(seen.before);
    to.motion[2 * pixel] = motion.x();
    to.motion[2 * pixel + 1] = 0.0F - motion.y();  // up, and no -0
  }
}

}  // namespace

void write_seen(const SeenScene& scene, const Tile& tile, const SeenChannels& to) {
  std::vector<Ray> rays;
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x)
      rays.push_back(scene.camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F));
  }
  std::vector<MeshHit> hits(rays.size());
  scene.geometry.caster().intersect(rays, Coherence::coherent, hits);
  std::size_t i = 0;
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x, ++i) {
      const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(scene.camera.width()) +
                         static_cast<std::size_t>(x);
      write(scene, to, pixel, rays[i], seen_by(scene, rays[i], hits[i]));
    }
  }
}

}  // namespace lagomorph::render::path
