#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/raster/caster_grid.h"
#include "render/raster/frame_block.h"
#include "render/raster/view_range.h"

namespace lagomorph::render::raster {

/// Side of a tile [pixels]; even, so that no quad of pixels is in two.
constexpr int tile_size = 16;

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
