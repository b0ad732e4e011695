#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render/raster/ground_tiles.h"
#include "render/raster/lit_pixels.h"
#include "render/raster/view_range.h"

namespace lagomorph::render::raster {

/// The picture without the meshes, and what they can take from the ground in it (still_fragment): rows from
/// below.
struct StillParts {
  int width = 0, height = 0;
  int lights = 0;
  std::vector<float> picture;  // linear colour, interleaved
  /// Half floats, a plane each, in the order of still_fragment's outputs: red, green, blue of what the sky's
  /// light becomes, of the sky mirrored, of each light, and of the mirrored mesh.
  std::unique_ptr<std::uint16_t[]> planes;                 // of the tiles that were asked for
  Color open = Color::Zero(), from_below = Color::Zero();  // irradiance of the ground with nothing before it

  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  std::size_t part_count() const {
    return 3 + static_cast<std::size_t>(lights);
  }  // of still_fragment's parts
  std::size_t plane_count() const { return 3 * part_count(); }
};

/// The part of the sky that the ground's map sees, rows from below: three colours a texel.
struct GroundSeen {
  int size = 0;
  std::vector<Color> texels;
};

/// Of what light_ground_map() found. Outside of the map all is seen; it meets that at its border.
GroundSeen ground_seen(const LitPixels&);

/// The drawn rectangle of the still picture into `color`, interleaved, rows from the top, in these tiles less
/// what the meshes take: their shadows (light_ground()) and the sky that they hide; of what the ground
/// mirrors nothing where rays see to that.
void copy_less_taken(const FrameBlock&, const StillParts&, const GroundSeen&, std::span<const TileRun>,
                     const LitPixels&, const PixelRectangle& drawn, bool mirrored_by_rays,
                     std::span<float> color);

}  // namespace lagomorph::render::raster
