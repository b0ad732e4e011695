#include "render/raster/stand_ins.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace lagomorph::render::raster {
namespace {

using std::numbers::pi;

/// So far that its light is parallel to a degree over the ground, and so near that single precision still
/// resolves its shadows.
float distance_of_suns(const RenderScene& scene) {
  Eigen::AlignedBox3f box;
  for (const Mesh& mesh : scene.meshes) {
    for (const Vec3& p : mesh.positions) box.extend(p);
  }
  const float meshes = box.isEmpty() ? 1.0F : box.diagonal().norm();
  return std::max(100.0F * meshes, scene.ground.enabled ? 50.0F * scene.ground.radius : 0.0F);
}

Vec3 middle_of(const RenderScene& scene) {
  Eigen::AlignedBox3f box;
  for (const Mesh& mesh : scene.meshes) {
    for (const Vec3& p : mesh.positions) box.extend(p);
  }
  return box.isEmpty() ? scene.ground.center : Vec3(box.center());
}

AreaLight far_square(const Sun& sun, const Vec3& middle, float distance) {
  const float angle = solid_angle(sun);
  AreaLight light;
  light.look_at = middle;
  light.position = middle - distance * sun.direction.normalized();
  light.size = Vec2::Constant(distance * std::sqrt(angle));
  light.color = sun.color;
  light.radiance = sun.irradiance / angle;
  return light;
}

}  // namespace

float solid_angle(const Sun& sun) {
  const double chord = 2.0 * std::sin(static_cast<double>(sun.angle) * pi / 720.0);
  return static_cast<float>(pi * chord * chord);
}

RenderScene with_stand_ins(const RenderScene& scene) {
  RenderScene drawn = scene;
  drawn.meshes.clear();
  const Vec3 middle = middle_of(scene);
  const float distance = distance_of_suns(scene);
  for (const Sun& sun : scene.suns) drawn.lights.push_back(far_square(sun, middle, distance));
  return drawn;
}

std::vector<std::string> stand_in_remarks(const CameraSettings& camera, const RenderScene& scene) {
  std::vector<std::string> remarks;
  if (camera.f_stop > 0.0F && !camera.orthographic)
    remarks.emplace_back("camera.f_stop: everything is drawn sharp");
  if (scene.motion_segments > 0)
    remarks.emplace_back(
        "camera.shutter: drawn without motion blur of bodies or camera, as all is when the shutter closes");
  if (!scene.suns.empty()) remarks.emplace_back("a sun is a far square light of its size");
  return remarks;
}

}  // namespace lagomorph::render::raster
