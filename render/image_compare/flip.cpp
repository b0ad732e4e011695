#include "render/image_compare/flip.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "render/image_compare/flip_tile.h"

namespace lagomorph::render {
namespace {

// Tiles whose planes stay in a core's second cache; wide enough that halos cost little.
constexpr int widest_tile = 512;
constexpr int tile_rows = 64;

std::vector<Tile> tiles_of(int width, int height) {
  const int across = (width + widest_tile - 1) / widest_tile;
  std::vector<Tile> tiles;
  for (int y = 0; y < height; y += tile_rows) {
    for (int i = 0; i < across; ++i) {
      const int x = width * i / across;
      tiles.push_back({x, y, width * (i + 1) / across - x, std::min(tile_rows, height - y)});
    }
  }
  return tiles;
}

/// Whether all that the tile's values depend on is the same in both pictures. FLIP is then 0.
bool same(const LinearPair& pair, const Tile& tile, int halo) {
  const int x = std::max(tile.x - halo, 0);
  const int count = std::min(tile.x + tile.width + halo, pair.width()) - x;
  const int end = std::min(tile.y + tile.height + halo, pair.height());
  for (int y = std::max(tile.y - halo, 0); y < end; ++y) {
    if (!pair.same(y, x, count)) return false;
  }
  return true;
}

}  // namespace

ErrorMap flip_map(const LinearPair& pair, double pixels_per_degree, InstructionSet set) {
  const FlipFilters filters = flip_filters(pixels_per_degree);
  const std::vector<Tile> tiles = tiles_of(pair.width(), pair.height());
  const auto stride = static_cast<std::size_t>(pair.width());
  ErrorMap map{pair.width(), pair.height(),
               std::vector<float>(stride * static_cast<std::size_t>(pair.height()))};
  tbb::enumerable_thread_specific<std::vector<float>> scratch;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size(), 1), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Tile& tile = tiles[i];
      if (same(pair, tile, static_cast<int>(filters.halo()))) continue;
      float* out =
          map.values.data() + static_cast<std::size_t>(tile.y) * stride + static_cast<std::size_t>(tile.x);
      flip_tile(pair, filters, tile, set, scratch.local(), out, stride);
    }
  });
  return map;
}

}  // namespace lagomorph::render
