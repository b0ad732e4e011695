#include "render/raster/view_range.h"

#include <algorithm>
#include <limits>

namespace lagomorph::render::raster {

namespace {

template <typename Add>
void for_each_corner(const Vec3& center, const Vec3& a, const Vec3& b, Add add) {
  for (const float s : {-1.0F, 1.0F}) {
    for (const float t : {-1.0F, 1.0F}) add(Vec3(center + s * a + t * b));
  }
}

template <typename Add>
void for_each_point(std::span<const std::vector<Vec3>> positions, const RenderScene& scene, Add add) {
  for (const std::vector<Vec3>& mesh : positions) {
    for (const Vec3& p : mesh) add(p);
  }
  for (const AreaLight& light : scene.lights) {
    if (!light.visible) continue;
    const LightFrame frame = light_frame(light);
    for_each_corner(light.position, 0.5F * light.size.x() * frame.right, 0.5F * light.size.y() * frame.up,
                    add);
  }
}

}  // namespace

ViewRange view_range(const Camera& camera, std::span<const std::vector<Vec3>> positions,
                     const RenderScene& scene) {
  float nearest = std::numeric_limits<float>::max();
  float farthest = 0.0F;
  const auto add = [&](const Vec3& p) {
    const float depth = camera.depth(p);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  };
  for_each_point(positions, scene, add);
  const Ground& g = scene.ground;
  if (g.enabled) {
    for_each_corner(Vec3(g.center.x(), g.height, g.center.z()), g.radius * Vec3::UnitX(),
                    g.radius * Vec3::UnitZ(), add);
  }
  if (!(farthest > 0.0F)) return {};  // nothing is before the camera
  ViewRange range;
  range.far = 1.01F * farthest;
  range.near = std::max(0.99F * nearest, camera.is_orthographic() ? 0.0F : 1e-4F * range.far);
  return range;
}

PixelRectangle seen_rectangle(const Camera& camera, std::span<const std::vector<Vec3>> positions,
                              const RenderScene& scene) {
  const ViewRange range = view_range(camera, positions, scene);
  const Vec2 size(static_cast<float>(camera.width()), static_cast<float>(camera.height()));
  Vec2 low = Vec2::Constant(std::numeric_limits<float>::max());
  Vec2 high = -low;
  for_each_point(positions, scene, [&](const Vec3& p) {
    if (!camera.is_orthographic() && camera.depth(p) < range.near) {  // its triangles may be anywhere
      low = Vec2::Zero();
      high = size;
      return;
    }
    const Vec2 at = camera.project(p);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  });
  low = (low.array() - 2.0F).floor().max(0.0F).matrix();
  high = (high.array() + 2.0F).ceil().matrix().cwiseMin(size);
  if ((high - low).minCoeff() <= 0.0F) return {};
  return {static_cast<int>(low.x()), camera.height() - static_cast<int>(high.y()),
          static_cast<int>(high.x() - low.x()), static_cast<int>(high.y() - low.y())};
}

PixelRectangle mirrored_rectangle(const Camera& camera, std::span<const std::vector<Vec3>> positions,
                                  const RenderScene& scene) {
  RenderScene ground_alone;
  ground_alone.ground = scene.ground;
  std::vector<std::vector<Vec3>> below(positions.begin(), positions.end());
  for (std::vector<Vec3>& mesh : below) {
    for (Vec3& p : mesh) p.y() = 2.0F * scene.ground.height - p.y();
  }
  PixelRectangle r = seen_rectangle(camera, below, ground_alone);
  if (r.width <= 0) return r;
  // A lobe's width, from any distance.
  const float roughness = scene.ground.material.roughness;
  const int more = static_cast<int>(2.0F * roughness * roughness * static_cast<float>(r.width + r.height));
  r = {r.x - more, r.y - more, r.width + 2 * more, r.height + 2 * more};
  return common_rectangle(r, {0, 0, camera.width(), camera.height()});
}

bool ground_may_hide(const Camera& camera, std::span<const std::vector<Vec3>> positions,
                     const Ground& ground) {
  if (!ground.enabled) return false;
  if (camera.is_orthographic() || camera.position().y() <= ground.height) return true;
  return std::any_of(positions.begin(), positions.end(), [&](const std::vector<Vec3>& mesh) {
    return std::any_of(mesh.begin(), mesh.end(), [&](const Vec3& p) { return p.y() < ground.height; });
  });
}

PixelRectangle rectangle_of(const PixelRegion& r, int height) {
  return {r.x0, height - r.y1, r.width(), r.height()};
}

PixelRectangle common_rectangle(const PixelRectangle& a, const PixelRectangle& b) {
  const int x = std::max(a.x, b.x), y = std::max(a.y, b.y);
  return {x, y, std::max(0, std::min(a.x + a.width, b.x + b.width) - x),
          std::max(0, std::min(a.y + a.height, b.y + b.height) - y)};
}

}  // namespace lagomorph::render::raster
