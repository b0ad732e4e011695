#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/raster/depth_maps.h"
#include "render/raster/frame_block.h"
#include "render/raster/ground_tiles.h"
#include "render/raster/receivers.h"

namespace lagomorph::render::raster {

/// Four parts in [0, 1], as 16-bit fractions.
using Parts = std::array<std::uint16_t, 4>;

/// What the shaders read of a rectangle's pixels, rows from below: the part of each of four lights that is
/// seen, and of the sky, see SkySeen.
struct LitPixels {
  PixelRectangle at;
  std::vector<Parts> lights, diffuse, mirrored;  // the last two where they are asked for; else empty
};

/// The smallest rectangle of whole quads of cells around one, in a picture of such or a little less.
PixelRectangle whole_cells(const PixelRectangle&);

/// What must be lit for the light in a rectangle to be that of the whole picture, to the bit: neighbours
/// share.
PixelRectangle with_neighbours(const PixelRectangle&);

/// Of the ground in tiles, where their lights may be hidden: the lights alone, of the rectangle around them.
void light_ground(const FrameBlock&, const DepthMaps&, std::span<const TileRun>, LitPixels&);
/// Of surfaces in such a rectangle, see whole_cells(). Returns false, with nothing made, where no texel has a
/// depth.
bool light_surfaces(const FrameBlock&, const DepthMaps&, const PixelRectangle&, std::span<const SurfaceTexel>,
                    LitPixels&);
/// Of the ground's map: lights, and what falls on it of the sky.
void light_ground_map(const FrameBlock&, const DepthMaps&, LitPixels&);

}  // namespace lagomorph::render::raster
