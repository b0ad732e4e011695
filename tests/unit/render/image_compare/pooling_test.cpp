#include "render/image_compare/pooling.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace lagomorph::render {
namespace pooling_test {

ErrorMap noise_map(int width, int height, std::uint32_t seed) {
  ErrorMap map{width, height, {}};
  std::uint32_t state = seed;
  for (int i = 0; i < width * height; ++i) {
    state = state * 1664525U + 1013904223U;
    const float v = static_cast<float>(state >> 8U) * 0x1p-24F;
    map.values.push_back(v < 0.3F ? 0.0F : v * v * v);
  }
  return map;
}

/// The definition: sort, add up, take the first whose running sum exceeds the share.
std::array<double, 3> slow_quartiles(const ErrorMap& map) {
  std::vector<float> sorted = map.values;
  std::sort(sorted.begin(), sorted.end());
  double total = 0;
  for (const float v : sorted) total += v;
  std::array<double, 3> quartiles{};
  for (std::size_t i = 0; i < 3; ++i) {
    double sum = 0;
    for (const float v : sorted) {
      sum += v;
      if (sum > 0.25 * static_cast<double>(i + 1) * total) {
        quartiles[i] = v;
        break;
      }
    }
  }
  return quartiles;
}

TEST(Pooling, MeanAndRange) {
  const ErrorMap map{3, 2, {0.5F, 0.25F, 0.0F, 1.0F, 0.125F, 0.125F}};
  EXPECT_DOUBLE_EQ(mean(map), 2.0 / 6);
  EXPECT_EQ(range(map).least, 0);
  EXPECT_EQ(range(map).most, 1);
}

TEST(Pooling, WeightedQuartilesAreThoseOfTheSortedMap) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const ErrorMap map = noise_map(101, 47, seed);
    EXPECT_EQ(weighted_quartiles(map), slow_quartiles(map)) << seed;
  }
}

TEST(Pooling, WeightedQuartilesOfConstantAndSparseMaps) {
  const ErrorMap zeros{7, 5, std::vector<float>(35, 0.0F)};
  EXPECT_EQ(weighted_quartiles(zeros), (std::array<double, 3>{0, 0, 0}));
  const ErrorMap ones{7, 5, std::vector<float>(35, 1.0F)};
  EXPECT_EQ(weighted_quartiles(ones), (std::array<double, 3>{1, 1, 1}));
  ErrorMap one_pixel = zeros;
  one_pixel.values[17] = 0.375F;
  EXPECT_EQ(weighted_quartiles(one_pixel), (std::array<double, 3>{0.375, 0.375, 0.375}));
  // 0.25 alone makes a quarter of the total and does not exceed it.
  const ErrorMap steps{3, 1, {0.25F, 0.25F, 0.5F}};
  EXPECT_EQ(weighted_quartiles(steps), (std::array<double, 3>{0.25, 0.5, 0.5}));
}

TEST(Pooling, LargestTile) {
  for (const auto& [width, height] : {std::pair{16, 16}, {48, 32}, {37, 21}, {5, 3}, {17, 1}, {1, 40}}) {
    const ErrorMap map = noise_map(width, height, 9);
    TileMean expected{.tile = {}, .mean = -1};
    for (int y = 0; y < height; y += 16) {
      for (int x = 0; x < width; x += 16) {
        const Tile tile{x, y, std::min(16, width - x), std::min(16, height - y)};
        double sum = 0;
        for (int j = y; j < y + tile.height; ++j) {
          for (int i = x; i < x + tile.width; ++i) sum += map.row(j)[i];
        }
        const double tile_mean = sum / (tile.width * tile.height);
        if (tile_mean > expected.mean) expected = {tile, tile_mean};
      }
    }
    const TileMean found = largest_tile_mean(map);
    EXPECT_DOUBLE_EQ(found.mean, expected.mean);
    EXPECT_EQ(found.tile.x, expected.tile.x);
    EXPECT_EQ(found.tile.y, expected.tile.y);
    EXPECT_EQ(found.tile.width, expected.tile.width);
    EXPECT_EQ(found.tile.height, expected.tile.height);
  }
}

TEST(Pooling, OfEqualTilesTheFirst) {
  const ErrorMap map{64, 64, std::vector<float>(64 * 64, 0.5F)};
  EXPECT_EQ(largest_tile_mean(map).tile.x, 0);
  EXPECT_EQ(largest_tile_mean(map).tile.y, 0);
}

TEST(Pooling, TheSameBitsForEveryNumberOfThreads) {
  const ErrorMap map = noise_map(333, 257, 4);
  const double one = [&] {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
    return mean(map);
  }();
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 4);
  for (int i = 0; i < 20; ++i) ASSERT_EQ(mean(map), one);
}

}  // namespace pooling_test
}  // namespace lagomorph::render
