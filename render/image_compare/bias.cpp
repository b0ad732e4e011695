#include "render/image_compare/bias.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace lagomorph::render {
namespace {

using Sums = std::array<std::int64_t, 3>;

template <class Sample>
Sums difference(const Pixels& a, const Pixels& b, const Tile& tile) {
  const auto& p = std::get<std::vector<Sample>>(a.samples);
  const auto& q = std::get<std::vector<Sample>>(b.samples);
  const auto step_p = static_cast<std::size_t>(a.samples_per_pixel());
  const auto step_q = static_cast<std::size_t>(b.samples_per_pixel());
  Sums sums{};
  for (int y = tile.y; y < tile.y + tile.height; ++y) {
    const auto first =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width) + static_cast<std::size_t>(tile.x);
    for (std::size_t i = first; i < first + static_cast<std::size_t>(tile.width); ++i) {
      for (std::size_t c = 0; c < 3; ++c)
        sums[c] += std::int64_t{q[i * step_q + c]} - std::int64_t{p[i * step_p + c]};
    }
  }
  return sums;
}

template <class Sample>
TileBias bias(const Pixels& a, const Pixels& b) {
  TileBias result{a.width, a.height, {}};
  result.tiles.resize(static_cast<std::size_t>(result.columns()) * static_cast<std::size_t>(result.rows()));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, result.tiles.size(), 64), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Tile tile = result.place(i);
      const Sums sums = difference<Sample>(a, b, tile);
      const double full = 1.0 * std::numeric_limits<Sample>::max() * tile.width * tile.height;
      for (std::size_t c = 0; c < 3; ++c)
        result.tiles[i][c] = static_cast<float>(static_cast<double>(sums[c]) / full);
    }
  });
  return result;
}

}  // namespace

Tile TileBias::place(std::size_t i) const {
  const int x = static_cast<int>(i) % columns() * tile_size, y = static_cast<int>(i) / columns() * tile_size;
  return {x, y, std::min(tile_size, width - x), std::min(tile_size, height - y)};
}

TileBias tile_bias(const Pixels& a, const Pixels& b) {
  return a.bit_depth() == 8 ? bias<std::uint8_t>(a, b) : bias<std::uint16_t>(a, b);
}

BiasFigures bias_figures(const TileBias& bias) {
  BiasFigures figures;
  figures.tile.tile = bias.place(0);
  std::array<double, 3> sums{};
  for (std::size_t i = 0; i < bias.tiles.size(); ++i) {
    const Tile tile = bias.place(i);
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = bias.tiles[i][c];
      sums[c] += value * tile.width * tile.height;
      if (std::abs(value) > figures.tile.mean) figures.tile = {tile, std::abs(value)};  // of equals the first
    }
  }
  for (const double sum : sums)
    figures.mean = std::max(figures.mean, std::abs(sum) / (1.0 * bias.width * bias.height));
  return figures;
}

TileBias change_of_bias(const TileBias& before, const TileBias& now) {
  TileBias change{now.width, now.height, {}};
  if (before.width != now.width || before.height != now.height) return change;
  if (before.tiles.empty() && now.tiles.empty()) return change;
  change.tiles.resize(std::max(before.tiles.size(), now.tiles.size()));
  for (std::size_t i = 0; i < change.tiles.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      change.tiles[i][c] =
          (now.tiles.empty() ? 0.0F : now.tiles[i][c]) - (before.tiles.empty() ? 0.0F : before.tiles[i][c]);
    }
  }
  return change;
}

}  // namespace lagomorph::render
