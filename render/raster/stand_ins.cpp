#include "render/raster/stand_ins.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "render/raster/sky_model.h"

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

Sky gradient_of(const SkyMap& map) {
  // Irradiance of the upper half on a surface that faces up, and on vertical ones in the mean over their
  // azimuths: a direction at the height y gives them y and sqrt(1 - y^2) / pi.
  Eigen::Array3d up = Eigen::Array3d::Zero();
  Eigen::Array3d side = Eigen::Array3d::Zero();
  for (int row = 0; row < map.height(); ++row) {
    const double top = std::cos(pi * row / map.height());
    const double bottom = std::cos(pi * (row + 1) / map.height());
    const double low = std::max(bottom, 0.0);
    if (top <= low) break;
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    for (int x = 0; x < map.width(); ++x) sum += map.texel(x, row).cast<double>();
    const double y = 0.5 * (top + low);
    sum *= 2.0 * pi * (top - low) / map.width();
    up += y * sum;
    side += std::sqrt(1.0 - y * y) / pi * sum;
  }
  const SkyIrradiance a = sky_irradiance(1.0F);
  const SkyIrradiance b = sky_irradiance(0.0F);
  const auto det = static_cast<double>(a.horizon) * b.zenith - static_cast<double>(a.zenith) * b.horizon;
  Sky sky;
  sky.strength = 1.0F;
  for (int k = 0; k < 3; ++k) {
    double horizon = (up[k] * b.zenith - side[k] * a.zenith) / det;
    double zenith = (side[k] * a.horizon - up[k] * b.horizon) / det;
    // No gradient is so steep: what faces up is right.
    if (horizon < 0.0) horizon = 0.0, zenith = up[k] / a.zenith;
    if (zenith < 0.0) zenith = 0.0, horizon = up[k] / a.horizon;
    sky.horizon[k] = static_cast<float>(horizon);
    sky.zenith[k] = static_cast<float>(zenith);
  }
  return sky;
}

RenderScene with_stand_ins(const RenderScene& scene) {
  RenderScene drawn = scene;
  drawn.meshes.clear();
  const Vec3 middle = middle_of(scene);
  const float distance = distance_of_suns(scene);
  for (const Sun& sun : scene.suns) drawn.lights.push_back(far_square(sun, middle, distance));
  if (scene.sky.map) {
    drawn.sky = gradient_of(*scene.sky.map);
    drawn.sky.strength = scene.sky.strength;
  }
  return drawn;
}

std::vector<std::string> stand_in_remarks(const CameraSettings& camera, const RenderScene& scene) {
  std::vector<std::string> remarks;
  if (camera.f_stop > 0.0F && !camera.orthographic)
    remarks.emplace_back("camera.f_stop: everything is drawn sharp");
  if (scene.moving)
    remarks.emplace_back("camera.shutter: drawn without motion blur, as it is when the shutter closes");
  if (!scene.suns.empty())
    remarks.emplace_back("a sun is a far square light of its size; its disc is not drawn in the sky");
  if (scene.sky.map) {
    remarks.emplace_back(
        "the sky's map is a gradient from horizon to zenith that gives as much light, also where the camera "
        "sees it");
  }
  return remarks;
}

}  // namespace lagomorph::render::raster
