#include "render/image_compare/pooling.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace lagomorph::render {
namespace {

/// One result a group of rows, each by one thread, in order.
template <class Result, class Function>
std::vector<Result> by_groups(int height, int rows, const Function& of_rows) {
  std::vector<Result> results(static_cast<std::size_t>((height + rows - 1) / rows));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, results.size()), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const int first = static_cast<int>(i) * rows;
      results[i] = of_rows(first, std::min(first + rows, height));
    }
  });
  return results;
}

std::span<const float> row_of(const ErrorMap& map, int y) {
  return {map.row(y), static_cast<std::size_t>(map.width)};
}

/// Values that are not negative are in the order of their bits. Those of [0, 1] are two digits of 15 bits.
constexpr std::uint32_t digit_bits = 15;
constexpr std::uint32_t digits = 1U << digit_bits;
std::uint32_t high_digit(float value) { return std::bit_cast<std::uint32_t>(value) >> digit_bits; }
std::uint32_t low_digit(float value) { return std::bit_cast<std::uint32_t>(value) & (digits - 1); }

struct Found {
  std::uint32_t bin = 0;
  double before = 0;  // sum of all bins before it
};

/// The first bin with which the running sum, begun at `sum`, exceeds `target`; where rounding lets none
/// exceed it, the last that holds anything.
Found find_bin(const std::vector<double>& bins, double sum, double target) {
  Found found;
  for (std::uint32_t i = 0; i < digits; ++i) {
    if (bins[i] == 0) continue;
    found = {i, sum};
    sum += bins[i];
    if (sum > target) break;
  }
  return found;
}

}  // namespace

double mean(const ErrorMap& map) {
  const std::vector<double> rows = by_groups<double>(map.height, 1, [&](int y, int) {
    double sum = 0;
    for (const float value : row_of(map, y)) sum += value;
    return sum;
  });
  double sum = 0;
  for (const double row : rows) sum += row;
  return sum / static_cast<double>(map.values.size());
}

Range range(const ErrorMap& map) {
  const auto [least, most] = std::minmax_element(map.values.begin(), map.values.end());
  return {*least, *most};
}

std::array<double, 3> weighted_quartiles(const ErrorMap& map) {
  std::vector<double> high(digits);
  for (const float value : map.values) high[high_digit(value)] += value;
  double total = 0;
  for (const double bin : high) total += bin;
  std::array<double, 3> quartiles{};
  if (total == 0) return quartiles;
  for (std::size_t i = 0; i < 3; ++i) {
    const double target = 0.25 * static_cast<double>(i + 1) * total;
    const Found coarse = find_bin(high, 0, target);
    std::vector<double> low(digits);
    for (const float value : map.values) {
      if (high_digit(value) == coarse.bin) low[low_digit(value)] += value;
    }
    const Found fine = find_bin(low, coarse.before, target);
    quartiles[i] = std::bit_cast<float>((coarse.bin << digit_bits) | fine.bin);
  }
  return quartiles;
}

TileMean largest_tile_mean(const ErrorMap& map) {
  const auto of_band = [&](int first, int end) {
    std::vector<double> sums(static_cast<std::size_t>((map.width + tile_size - 1) / tile_size));
    for (int y = first; y < end; ++y) {
      const std::span<const float> row = row_of(map, y);
      for (std::size_t tile = 0; tile < sums.size(); ++tile) {
        for (const float value :
             row.subspan(tile * tile_size)
                 .first(std::min<std::size_t>(tile_size, row.size() - tile * tile_size))) {
          sums[tile] += value;
        }
      }
    }
    TileMean largest{.tile = {}, .mean = -1};
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const int x = static_cast<int>(i) * tile_size;
      const Tile tile{x, first, std::min(tile_size, map.width - x), end - first};
      const double tile_mean = sums[i] / (tile.width * tile.height);
      if (tile_mean > largest.mean) largest = {tile, tile_mean};
    }
    return largest;
  };
  TileMean largest{.tile = {}, .mean = -1};
  for (const TileMean& band : by_groups<TileMean>(map.height, tile_size, of_band)) {
    if (band.mean > largest.mean) largest = band;
  }
  return largest;
}

}  // namespace lagomorph::render
