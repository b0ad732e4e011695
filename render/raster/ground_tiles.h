#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/raster/caster_grid.h"
#include "render/raster/frame_block.h"
#include "render/raster/view_range.h"

namespace lagomorph::render::raster {

/// The ray through a point of the picture [pixels from the lower left corner]; the direction has length 1
/// along the view axis. As pixel_ray() of the shaders.
struct PixelRay {
  Vec3 origin, direction;
};
PixelRay pixel_ray(const FrameBlock&, float x, float y);

/// Where that meets the ground's plane, and the depth along the view axis; nothing where it does not. As
/// meet_ground() of the shaders.
struct GroundPoint {
  Vec3 point;
  float depth;
};
std::optional<GroundPoint> ground_at_pixel(const FrameBlock&, float x, float y);

/// Side of a tile [pixels]; even, so that no quad of pixels is in two.
constexpr int tile_size = 16;

/// Tiles beside each other where meshes may take something from the ground's light.
struct TileRun {
  float left, lower, right, upper;  // borders [pixels], from the lower left corner of the picture
  std::uint32_t lights_hidden;      // bit i: they may hide a part of light i
};

/// All tiles of the drawn rectangle in which the ground may be seen under a shadow of a mesh (a grid a light)
/// or in the ground's map, both of this frame.
std::vector<TileRun> touched_tiles(const FrameBlock&, std::span<const CasterGrid>, int shadow_map,
                                   const PixelRectangle& drawn);

}  // namespace lagomorph::render::raster
