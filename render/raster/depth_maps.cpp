#include "render/raster/depth_maps.h"

#if defined(__GNUC__) && !defined(__clang__)
#define LAGOMORPH_SCALAR __attribute__((noinline, optimize("no-tree-vectorize", "no-tree-slp-vectorize")))
#else
#define LAGOMORPH_SCALAR
#endif

namespace lagomorph::render::raster {

LAGOMORPH_SCALAR void look_up(const DepthMap::value_type* map, const std::int32_t* at, std::size_t count,
                              std::int32_t* values) {
  for (std::size_t i = 0; i < count; ++i) values[i] = map[at[i]];
}

}  // namespace lagomorph::render::raster
