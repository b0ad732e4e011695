#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/raster/frame_block.h"
#include "render/raster/pixel_block.h"

namespace lagomorph::render::raster {

/// Rows from below, depths from 0 to 1 in steps of 1 / no_depth: half the memory of floats, which is what
/// looking them up takes its time for.
using DepthMap = std::vector<std::uint16_t>;
constexpr std::uint16_t no_depth = 65535;  // nothing is there

/// A light as a depth map sees from its middle, or one of the equal rectangles that a large light is split
/// into, see light_parts.h.
struct LightPart {
  LightBlock light;
  int map_size;                  // [texels]
  int search_taps, filter_taps;  // of each of a quad's pixels
  bool alone = true;             // the whole light: its shadow's edges may be narrower than a pixel
};

/// Of a light, among those of all.
struct LightParts {
  std::size_t first, count;
  bool below_ground;  // some of it is, which the ground hides
};

/// Those of one frame.
struct DepthMaps {
  std::vector<LightParts> lights;
  std::vector<LightPart> parts;
  std::vector<DepthMap> parts_maps;  // one each
  int sky_size = 0;
  std::vector<DepthMap> sky;             // one a direction; none: there are no meshes
  std::vector<DepthMap> sky_from_below;  // likewise, for the ground
  bool see_through = false;              // some meshes are drawn as dots, see Caster
  bool sky_is_map = false;
};

/// Texels of one batch: of four taps or the four around a tap, all lanes of one after those of another.
constexpr int batch = 4;
using BatchIndices = std::array<std::int32_t, batch * lanes>;

/// values[i] = map[at[i]], one by one: gathering by vector instructions takes twice as long.
void look_up(const DepthMap::value_type* map, const std::int32_t* at, std::size_t count,
             std::int32_t* values);

}  // namespace lagomorph::render::raster
