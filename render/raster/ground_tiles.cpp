#include "render/raster/ground_tiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace lagomorph::render::raster {
namespace {

struct Box2 {
  Vec2 low = Vec2::Constant(std::numeric_limits<float>::max());
  Vec2 high = Vec2::Constant(std::numeric_limits<float>::lowest());
  void add(const Vec2& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
};

/// Whether blockers of a light may be found from somewhere between the points: find_blockers().
bool may_be_hidden(const LightBlock& light, const CasterGrid& casters, int shadow_map,
                   const std::array<Vec3, 4>& points) {
  Box2 box;
  float farthest = 0.0F;
  for (const Vec3& x : points) {
    const Vec3 d = x - light.position.head<3>();
    const float along = d.dot(light.normal.head<3>());
    if (!(along > 1e-3F)) return casters.meets(Vec2::Zero(), Vec2::Ones());
    box.add(Vec2(d.dot(light.right.head<3>()), d.dot(light.up.head<3>())) / along);
    farthest = std::max(farthest, along);
  }
  if (1.0F / farthest >= light.depth.z()) return false;  // before all meshes
  const float reach = std::max(light.depth.z() - 1.0F / farthest, 0.0F);
  const Vec2 half_size(light.right.w(), light.up.w());
  const Vec2 scale = light.map.head<2>(), offset = light.map.tail<2>();
  // The least reach, what the search rounds to a texel, and a little.
  const Vec2 margin = Vec2::Constant(8.0F / static_cast<float>(shadow_map));
  const Vec2 low = (box.low - reach * half_size).cwiseProduct(scale) + offset - margin;
  const Vec2 high = (box.high + reach * half_size).cwiseProduct(scale) + offset + margin;
  // Beyond the map's borders the search sees its outermost texels.
  if ((high.array() < 0.0F).any() || (low.array() > 1.0F).any()) return false;
  return casters.meets(low, high);
}

}  // namespace

TileCorners tile_corners(const FrameBlock& frame, int x, int y) {
  const auto left = static_cast<float>(x), lower = static_cast<float>(y);
  constexpr auto side = static_cast<float>(tile_size);
  return {{ground_at_pixel(frame, left, lower), ground_at_pixel(frame, left + side, lower),
           ground_at_pixel(frame, left, lower + side), ground_at_pixel(frame, left + side, lower + side)}};
}

float distance_from_middle(const FrameBlock& frame, std::span<const Vec3> points) {
  Box2 box;
  for (const Vec3& p : points) box.add({p.x(), p.z()});
  const Vec2 middle(frame.ground_at.x(), frame.ground_at.z());
  return (middle.cwiseMax(box.low).cwiseMin(box.high) - middle).norm();
}

std::vector<TileRun> touched_tiles(const FrameBlock& frame, std::span<const CasterGrid> casters,
                                   int shadow_map, const PixelRectangle& drawn) {
  std::vector<TileRun> runs;
  if (frame.ground.w() < 0.5F || frame.counts.z() < 0.5F) return runs;
  std::uint32_t all = 0;
  for (std::size_t i = 0; i < casters.size(); ++i)
    all |= casters[i].meets(Vec2::Zero(), Vec2::Ones()) ? 1U << i : 0U;
  const int end_x = drawn.x + drawn.width, end_y = drawn.y + drawn.height;
  for (int y = drawn.y / tile_size * tile_size; y < end_y; y += tile_size) {
    bool goes_on = false;
    for (int x = drawn.x / tile_size * tile_size; x < end_x; x += tile_size) {
      const auto left = static_cast<float>(x), lower = static_cast<float>(y);
      const float right = left + static_cast<float>(tile_size), upper = lower + static_cast<float>(tile_size);
      const TileCorners corners = tile_corners(frame, x, y);
      std::uint32_t hidden = 0;
      bool touched = corners.count() > 0;
      if (const std::optional<std::array<Vec3, 4>> points = corners.all()) {
        Box2 on_map;
        for (const Vec3& p : *points)
          on_map.add(frame.ground_map.x() * Vec2(p.x(), p.z()) + frame.ground_map.tail<2>());
        touched = distance_from_middle(frame, *points) <= 1.001F * frame.ground.y();
        for (std::size_t i = 0; touched && i < casters.size(); ++i)
          hidden |= may_be_hidden(frame.lights[i], casters[i], shadow_map, *points) ? 1U << i : 0U;
        touched = touched && (hidden != 0 ||
                              ((on_map.low.array() <= 1.0F).all() && (on_map.high.array() >= 0.0F).all()));
      } else if (touched) {
        hidden = all;  // at the horizon
      }
      if (!touched) {
        goes_on = false;
      } else if (goes_on && runs.back().lights_hidden == hidden) {
        runs.back().right = right;
      } else {
        runs.push_back({left, lower, right, upper, hidden});
        goes_on = true;
      }
    }
  }
  return runs;
}

}  // namespace lagomorph::render::raster
