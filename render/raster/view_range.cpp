#include "render/raster/view_range.h"

#include <algorithm>
#include <limits>

namespace lagomorph::render::raster {

ViewRange view_range(const Camera& camera, std::span<const std::vector<Vec3>> positions,
                     const RenderScene& scene) {
  float nearest = std::numeric_limits<float>::max();
  float farthest = 0.0F;
  const auto add = [&](const Vec3& p) {
    const float depth = camera.depth(p);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  };
  for (const std::vector<Vec3>& mesh : positions) {
    for (const Vec3& p : mesh) add(p);
  }
  const auto add_rectangle = [&](const Vec3& center, const Vec3& a, const Vec3& b) {
    for (const float s : {-1.0F, 1.0F}) {
      for (const float t : {-1.0F, 1.0F}) add(center + s * a + t * b);
    }
  };
  const Ground& g = scene.ground;
  if (g.enabled) {
    add_rectangle(Vec3(g.center.x(), g.height, g.center.z()), g.radius * Vec3::UnitX(),
                  g.radius * Vec3::UnitZ());
  }
  for (const AreaLight& light : scene.lights) {
    if (!light.visible) continue;
    const LightFrame frame = light_frame(light);
    add_rectangle(light.position, 0.5F * light.size.x() * frame.right, 0.5F * light.size.y() * frame.up);
  }
  if (!(farthest > 0.0F)) return {};  // nothing is before the camera
  ViewRange range;
  range.far = 1.01F * farthest;
  range.near = std::max(0.99F * nearest, camera.is_orthographic() ? 0.0F : 1e-4F * range.far);
  return range;
}

}  // namespace lagomorph::render::raster
