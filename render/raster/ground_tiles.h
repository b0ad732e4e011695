#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/raster/caster_grid.h"
#include "render/raster/frame_block.h"
#include "render/raster/pixel_ray.h"
#include "render/raster/view_range.h"

namespace lagomorph::render::raster {

/// Side of a tile [pixels]; even, so that no quad of pixels is in two.
constexpr int tile_size = 16;

/// Where the corners of a tile, whose lower left pixel is (x, y), meet the ground's plane.
struct TileCorners {
  std::array<std::optional<GroundPoint>, 4> met;

  int count() const {
    return static_cast<int>(
        std::count_if(met.begin(), met.end(), [](const auto& c) { return c.has_value(); }));
  }
  /// Nothing where one of them does not.
  std::optional<std::array<Vec3, 4>> all() const {
    if (count() < 4) return std::nullopt;
    return std::array<Vec3, 4>{met[0]->point, met[1]->point, met[2]->point, met[3]->point};
  }
};
TileCorners tile_corners(const FrameBlock&, int x, int y);

/// From the middle of the ground's disc to the nearest point of the box around points of its plane. [m]
float distance_from_middle(const FrameBlock&, std::span<const Vec3> points);

/// Tiles beside each other where meshes may take something from the ground's light.
struct TileRun {
  float left, lower, right, upper;  // borders [pixels], from the lower left corner of the picture
  std::uint32_t lights_hidden;      // bit i: they may hide a part of light i
};

/// All tiles of the drawn rectangle in which the ground may be seen under a shadow of a mesh (a grid a light)
/// or in the ground's map, both of this frame. `shadow_map` is the size of the smallest map of a light.
std::vector<TileRun> touched_tiles(const FrameBlock&, std::span<const CasterGrid>, int shadow_map,
                                   const PixelRectangle& drawn);

}  // namespace lagomorph::render::raster
