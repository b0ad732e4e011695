#include "render/image_compare/differences.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <type_traits>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

namespace lagomorph::render {
namespace {

Differences joined(const Differences& a, const Differences& b) {
  return {a.samples + b.samples,       a.pixels + b.pixels,      a.sum + b.sum,
          a.square_sum + b.square_sum, std::max(a.most, b.most), a.full_scale};
}

/// Pixels whose 8-bit samples' sums 32 bits hold.
constexpr std::size_t chunk = 4096;

template <class Sample>
Differences dense(const Sample* p, const Sample* q, std::size_t count) {
  using Sum = std::conditional_t<sizeof(Sample) == 1, std::int32_t, std::uint64_t>;
  Sum sum = 0;
  Sum square_sum = 0;
  std::int32_t most = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t difference = std::abs(std::int32_t{p[i]} - std::int32_t{q[i]});
    sum += static_cast<Sum>(difference);
    square_sum += static_cast<Sum>(difference) * static_cast<Sum>(difference);
    most = std::max(most, difference);
  }
  std::uint64_t pixels = 0;
  for (std::size_t i = 0; i < count; i += 3) {
    const int bits = (p[i] ^ q[i]) | (p[i + 1] ^ q[i + 1]) | (p[i + 2] ^ q[i + 2]);
    pixels += bits != 0 ? 1U : 0U;
  }
  return {.samples = count,
          .pixels = pixels,
          .sum = static_cast<std::uint64_t>(sum),
          .square_sum = static_cast<std::uint64_t>(square_sum),
          .most = static_cast<std::uint32_t>(most),
          .full_scale = std::numeric_limits<Sample>::max()};
}

/// Copies R, G, B of some pixels together.
template <class Sample>
void gather(const Sample* rgba, std::size_t pixels, Sample* rgb) {
  for (std::size_t i = 0; i < pixels; ++i) std::copy_n(rgba + 4 * i, 3, rgb + 3 * i);
}

template <class Sample>
class Colors {
public:
  explicit Colors(const Pixels& pixels)
      : samples_(std::get<std::vector<Sample>>(pixels.samples).data()), alpha_(pixels.alpha) {}
  /// R, G, B of pixels first .. first + count - 1, in place or in `buffer`.
  const Sample* at(std::size_t first, std::size_t count, std::vector<Sample>& buffer) const {
    if (!alpha_) return samples_ + 3 * first;
    buffer.resize(3 * count);
    gather(samples_ + 4 * first, count, buffer.data());
    return buffer.data();
  }

private:
  const Sample* samples_;
  bool alpha_;
};

template <class Sample>
Differences of_colors(const Pixels& a, const Pixels& b) {
  const Colors<Sample> first(a);
  const Colors<Sample> second(b);
  const Differences none{.full_scale = std::numeric_limits<Sample>::max()};
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, a.pixel_count(), 65536), none,
      [&](const auto& range, Differences total) {
        std::vector<Sample> p;
        std::vector<Sample> q;
        for (std::size_t i = range.begin(); i < range.end(); i += chunk) {
          const std::size_t count = std::min(chunk, range.end() - i);
          total = joined(total, dense(first.at(i, count, p), second.at(i, count, q), 3 * count));
        }
        return total;
      },
      joined);
}

template <class Sample>
ErrorMap of_alpha(const Pixels& a, const Pixels& b) {
  constexpr float most = std::numeric_limits<Sample>::max();
  ErrorMap map{a.width, a.height, std::vector<float>(a.pixel_count())};
  const auto alpha = [&](const Pixels& pixels, std::size_t i) {
    return pixels.alpha ? static_cast<float>(std::get<std::vector<Sample>>(pixels.samples)[4 * i + 3]) : most;
  };
  for (std::size_t i = 0; i < map.values.size(); ++i)
    map.values[i] = std::abs(alpha(a, i) - alpha(b, i)) / most;
  return map;
}

}  // namespace

double Differences::mean_absolute() const {
  return static_cast<double>(sum) / (static_cast<double>(samples) * full_scale);
}

double Differences::largest() const { return static_cast<double>(most) / full_scale; }

double Differences::root_mean_square() const {
  return std::sqrt(static_cast<double>(square_sum) / static_cast<double>(samples)) / full_scale;
}

std::optional<double> Differences::psnr() const {
  if (square_sum == 0) return std::nullopt;
  return 20 * std::log10(1 / root_mean_square());
}

Differences color_differences(const Pixels& a, const Pixels& b) {
  return a.bit_depth() == 8 ? of_colors<std::uint8_t>(a, b) : of_colors<std::uint16_t>(a, b);
}

ErrorMap alpha_map(const Pixels& a, const Pixels& b) {
  return a.bit_depth() == 8 ? of_alpha<std::uint8_t>(a, b) : of_alpha<std::uint16_t>(a, b);
}

Pixels widened(const Pixels& pixels) {
  const auto* narrow = std::get_if<std::vector<std::uint8_t>>(&pixels.samples);
  if (narrow == nullptr) return pixels;
  Pixels wide{.width = pixels.width,
              .height = pixels.height,
              .channels = pixels.channels,
              .alpha = pixels.alpha,
              .samples = {}};
  std::vector<std::uint16_t> samples(narrow->size());
  std::transform(narrow->begin(), narrow->end(), samples.begin(),
                 [](std::uint8_t s) { return static_cast<std::uint16_t>(257 * s); });
  wide.samples = std::move(samples);
  return wide;
}

}  // namespace lagomorph::render
