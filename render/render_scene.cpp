#include "render/render_scene.h"

#include <algorithm>
#include <cmath>

namespace lagomorph::render {

Color sky_radiance(const Sky& sky, const Vec3& direction) {
  const float w = std::sqrt(std::max(direction.y(), 0.0F));
  return sky.strength * ((1.0F - w) * sky.horizon + w * sky.zenith);
}

Color background_radiance(const RenderScene& scene, const Vec3& direction) {
  return scene.background ? *scene.background : sky_radiance(scene.sky, direction);
}

float ground_fade(const Ground& ground, const Vec3& point) {
  const Vec2 d(point.x() - ground.center.x(), point.z() - ground.center.z());
  const float x =
      std::clamp((d.norm() - ground.fade_start) / (ground.radius - ground.fade_start), 0.0F, 1.0F);
  return x * x * (3.0F - 2.0F * x);
}

}  // namespace lagomorph::render
