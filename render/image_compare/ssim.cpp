#include "render/image_compare/ssim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "render/image_compare/error_map.h"

namespace lagomorph::render {
namespace {

constexpr std::ptrdiff_t radius = ssim_window / 2;
constexpr int tile_width = 256;
constexpr int tile_height = 64;
constexpr std::size_t channels = 3;

std::array<float, radius + 1> make_window() {
  constexpr double sigma = 1.5;
  std::array<double, radius + 1> half{};
  double total = 0;
  for (std::size_t k = 0; k < half.size(); ++k) {
    half[k] = std::exp(-0.5 * static_cast<double>(k * k) / (sigma * sigma));
    total += (k == 0 ? 1 : 2) * half[k];
  }
  std::array<float, radius + 1> window{};
  for (std::size_t k = 0; k < half.size(); ++k) window[k] = static_cast<float>(half[k] / total);
  return window;
}
const std::array<float, radius + 1> window = make_window();

/// Weighted mean and variance of p around each pixel, from differences to the pixel itself, so that nothing
/// cancels. With `inner`, the variances of p's own windows, whose mean adds to theirs (total variance).
template <std::size_t n>
LAGOMORPH_INLINE void moments(const float* p, std::ptrdiff_t step, const float* inner, float* mean,
                              float* variance) {
  const Lanes<n> here = load<n>(p);
  Lanes<n> sum{};
  Lanes<n> squares{};
  Lanes<n> within{};
  if (inner != nullptr) within = window[0] * load<n>(inner);
  for (std::ptrdiff_t k = 1; k <= radius; ++k) {
    const float w = window[static_cast<std::size_t>(k)];
    const Lanes<n> before = load<n>(p - k * step) - here;
    const Lanes<n> after = load<n>(p + k * step) - here;
    sum += w * (before + after);
    squares += w * (before * before + after * after);
    if (inner != nullptr) within += w * (load<n>(inner - k * step) + load<n>(inner + k * step));
  }
  store<n>(mean, here + sum);
  store<n>(variance, within + (squares - sum * sum));
}

/// Structural similarity by the moments of x + y and x - y: with s and d for them,
/// (1 - d^2 / ((s^2 + d^2)/2 + C1)) (1 - V_d / ((V_s + V_d)/2 + C2)) is Wang's Eq. 13.
LAGOMORPH_INLINE void similarity_row(const float* __restrict sum, const float* __restrict sum_variance,
                                     const float* __restrict difference,
                                     const float* __restrict difference_variance, float* __restrict out,
                                     std::size_t count) {
  constexpr float c1 = (0.01F * 255.0F) * (0.01F * 255.0F);
  constexpr float c2 = (0.03F * 255.0F) * (0.03F * 255.0F);
  for (std::size_t i = 0; i < count; ++i) {
    const float d2 = difference[i] * difference[i];
    const float luminance = 1.0F - d2 / (0.5F * (sum[i] * sum[i] + d2) + c1);
    const float vd = difference_variance[i];
    out[i] = luminance * (1.0F - vd / (0.5F * (sum_variance[i] + vd) + c2));
  }
}

/// Where things stand in a tile's memory: rows with a margin of the radius on both sides.
struct Work {
  std::size_t stride;
  std::size_t row;
  std::array<float*, 2> planes;  // x + y and x - y of one channel
  std::array<float*, 2> column_mean;
  std::array<float*, 2> column_variance;
  std::array<float*, 2> mean;
  std::array<float*, 2> variance;
  float* similarity;
};

/// Sum over a tile's windows of one channel.
template <std::size_t n>
LAGOMORPH_INLINE double tile_body(const Work& work, const Tile& tile) {
  const auto step = static_cast<std::ptrdiff_t>(work.stride);
  double sum = 0;
  for (std::size_t y = 0; y < static_cast<std::size_t>(tile.height); ++y) {
    for (std::size_t which = 0; which < 2; ++which) {
      const float* plane = work.planes[which] + (y + radius) * work.stride;
      float* mean = work.column_mean[which];
      float* variance = work.column_variance[which];
      for (std::size_t x = 0; x < work.stride; x += n) {
        moments<n>(plane + x, step, nullptr, mean + x, variance + x);
      }
      for (std::size_t x = 0; x < work.row; x += n) {
        moments<n>(mean + radius + x, 1, variance + radius + x, work.mean[which] + x,
                   work.variance[which] + x);
      }
    }
    similarity_row(work.mean[0], work.variance[0], work.mean[1], work.variance[1], work.similarity, work.row);
    for (int x = 0; x < tile.width; ++x) sum += work.similarity[x];
  }
  return sum;
}

double tile_base(const Work& work, const Tile& tile) { return tile_body<4>(work, tile); }
LAGOMORPH_AVX2 double tile_avx2(const Work& work, const Tile& tile) { return tile_body<8>(work, tile); }

template <class Sample>
struct View {
  explicit View(const Pixels& pixels)
      : samples(std::get<std::vector<Sample>>(pixels.samples).data()),
        width(static_cast<std::size_t>(pixels.width)),
        step(static_cast<std::size_t>(pixels.samples_per_pixel())) {}
  const Sample* at(std::size_t x, std::size_t y) const { return samples + (y * width + x) * step; }
  const Sample* samples;
  std::size_t width;
  std::size_t step;
};

/// x + y and x - y of one channel around a tile; whether the two are the same there.
template <class Sample>
bool read_tile(const View<Sample>& a, const View<Sample>& b, const Tile& tile, std::size_t channel,
               const Work& work) {
  constexpr float scale = 255.0F / std::numeric_limits<Sample>::max();
  const auto columns = static_cast<std::size_t>(tile.width) + 2 * radius;
  bool same = true;
  for (std::size_t y = 0; y < static_cast<std::size_t>(tile.height) + 2 * radius; ++y) {
    const Sample* p = a.at(static_cast<std::size_t>(tile.x), static_cast<std::size_t>(tile.y) + y) + channel;
    const Sample* q = b.at(static_cast<std::size_t>(tile.x), static_cast<std::size_t>(tile.y) + y) + channel;
    float* sum = work.planes[0] + y * work.stride;
    float* difference = work.planes[1] + y * work.stride;
    int differ = 0;
    for (std::size_t x = 0; x < columns; ++x) {
      const int i = p[x * a.step];
      const int j = q[x * b.step];
      differ |= i ^ j;
      sum[x] = scale * static_cast<float>(i + j);
      difference[x] = scale * static_cast<float>(i - j);
    }
    std::fill(sum + columns, sum + work.stride, 0.0F);
    std::fill(difference + columns, difference + work.stride, 0.0F);
    same = same && differ == 0;
  }
  return same;
}

Work place(const Tile& tile, std::vector<float>& scratch) {
  Work work{};
  work.row = whole_blocks(static_cast<std::size_t>(tile.width));
  work.stride = whole_blocks(work.row + 2 * radius);
  const std::size_t plane = (static_cast<std::size_t>(tile.height) + 2 * radius) * work.stride;
  // Vertical windows reach to the planes' rows only; horizontal ones may read `radius` past a column's end.
  const std::size_t size = 2 * plane + 4 * (work.stride + radius) + 5 * work.row;
  if (scratch.size() < size) scratch.resize(size);
  float* next = scratch.data();
  for (float*& p : work.planes) p = std::exchange(next, next + plane);
  for (auto* columns : {&work.column_mean, &work.column_variance}) {
    for (float*& p : *columns) p = std::exchange(next, next + work.stride + radius);
  }
  for (auto* rows : {&work.mean, &work.variance}) {
    for (float*& p : *rows) p = std::exchange(next, next + work.row);
  }
  work.similarity = next;
  return work;
}

template <class Sample>
double mean_similarity(const Pixels& a, const Pixels& b, InstructionSet set) {
  const View<Sample> first(a);
  const View<Sample> second(b);
  const int columns = a.width - 2 * static_cast<int>(radius);
  const int rows = a.height - 2 * static_cast<int>(radius);
  std::vector<Tile> tiles;
  for (int y = 0; y < rows; y += tile_height) {
    for (int x = 0; x < columns; x += tile_width) {
      tiles.push_back({x, y, std::min(tile_width, columns - x), std::min(tile_height, rows - y)});
    }
  }
  std::vector<double> sums(tiles.size());
  tbb::enumerable_thread_specific<std::vector<float>> scratch;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size(), 1), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Tile& tile = tiles[i];
      const Work work = place(tile, scratch.local());
      for (std::size_t channel = 0; channel < channels; ++channel) {
        const bool same = read_tile(first, second, tile, channel, work);
        sums[i] += same ? tile.width * tile.height
                        : (set == InstructionSet::avx2 ? tile_avx2 : tile_base)(work, tile);
      }
    }
  });
  double sum = 0;
  for (const double tile : sums) sum += tile;
  return sum / (static_cast<double>(columns) * rows * channels);
}

}  // namespace

std::optional<double> ssim(const Pixels& a, const Pixels& b, InstructionSet set) {
  if (std::min(a.width, a.height) < ssim_window) return std::nullopt;
  return a.bit_depth() == 8 ? mean_similarity<std::uint8_t>(a, b, set)
                            : mean_similarity<std::uint16_t>(a, b, set);
}

}  // namespace lagomorph::render
