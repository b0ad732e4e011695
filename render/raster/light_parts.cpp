#include "render/raster/light_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace lagomorph::render::raster {
namespace {

constexpr float widest_part = 0.15F;  // of the distance from the nearest mesh
// Of a sun's distance from all: the shadows of any body may fall on any other, however far behind.
constexpr float widest_part_of_suns = 0.06F;

/// From the light's middle to the nearest triangle's box of those that the light shines on; infinite if none.
float nearest_mesh(const AreaLight& light, std::span<const Mesh> meshes) {
  const Vec3 normal = light_frame(light).normal;
  float nearest = std::numeric_limits<float>::max();
  for (const Mesh& mesh : meshes) {
    for (const Triangle& t : mesh.triangles) {
      Eigen::AlignedBox3f box;
      bool lit = false;
      for (const auto v : t) {
        const Vec3& p = mesh.positions[static_cast<std::size_t>(v)];
        box.extend(p);
        lit |= (p - light.position).dot(normal) > 0.0F;
      }
      if (lit) nearest = std::min(nearest, box.squaredExteriorDistance(light.position));
    }
  }
  return std::sqrt(nearest);
}

/// Along a side of so much, no part wider than `widest`.
int parts_along(float side, float widest) {
  return static_cast<int>(std::clamp(std::ceil(side / widest), 1.0F, static_cast<float>(most_parts_along)));
}

}  // namespace

LightSplit split_of(const AreaLight& light, std::span<const Mesh> meshes, const Ground& ground) {
  const float widest = widest_part * std::max(nearest_mesh(light, meshes), 1e-6F);
  LightSplit split;
  split.across = parts_along(light.size.x(), widest);
  split.up = parts_along(light.size.y(), widest);
  const LightFrame frame = light_frame(light);
  const float reach =
      0.5F * (std::abs(frame.right.y()) * light.size.x() + std::abs(frame.up.y()) * light.size.y());
  split.below_ground = ground.enabled && light.position.y() - reach < ground.height;
  return split;
}

LightSplit split_of_sun(float solid_angle) {
  LightSplit split;
  split.across = split.up = parts_along(std::sqrt(solid_angle), widest_part_of_suns);
  return split;
}

LightBlock part_of(const LightBlock& light, const LightSplit& split, int k) {
  LightBlock part = light;
  const auto middle = [](int i, int n) { return static_cast<float>(2 * i + 1 - n) / static_cast<float>(n); };
  part.position.head<3>() +=
      middle(k % split.across, split.across) * light.right.w() * light.right.head<3>() +
      middle(k / split.across, split.up) * light.up.w() * light.up.head<3>();
  part.right.w() /= static_cast<float>(split.across);
  part.up.w() /= static_cast<float>(split.up);
  return part;
}

}  // namespace lagomorph::render::raster
