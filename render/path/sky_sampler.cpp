#include "render/path/sky_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lagomorph::render::path {
namespace {

constexpr double half_turn = std::numbers::pi;

double brightness(const Color& c) { return 0.2126 * c.x() + 0.7152 * c.y() + 0.0722 * c.z(); }

/// Mean luminance of the bilinear map over a texel: 3/4 of its own and 1/8 of each neighbour's, along both
/// axes.
double mean_luminance(const SkyMap& map, int x, int y) {
  const int left = (x + map.width() - 1) % map.width();
  const int right = (x + 1) % map.width();
  const auto along = [&](int row) {
    return 0.75 * brightness(map.texel(x, row)) +
           0.125 * (brightness(map.texel(left, row)) + brightness(map.texel(right, row)));
  };
  return 0.75 * along(y) + 0.125 * (along(std::max(y - 1, 0)) + along(std::min(y + 1, map.height() - 1)));
}

/// Cosine from straight up at the upper border of a row.
double border_cosine(const SkyMap& map, int y) { return std::cos(half_turn * y / map.height()); }

/// Makes running sums of n + 1 entries from the weights that stand in entries 1 .. n; their total.
double accumulate(double* sums, int n) {
  sums[0] = 0.0;
  for (int i = 1; i <= n; ++i) sums[i] += sums[i - 1];
  const double total = sums[n];
  if (total > 0.0) {
    for (int i = 1; i <= n; ++i) sums[i] /= total;
  }
  return total;
}

/// The interval that holds u, one of positive width, and where in it u is, in [0, 1].
int find(const double* sums, int n, double u, double& within) {
  const double* const above = std::upper_bound(sums + 1, sums + n, u);
  int i = static_cast<int>(above - sums) - 1;
  while (i > 0 && sums[i + 1] <= sums[i]) --i;
  within = std::clamp((u - sums[i]) / (sums[i + 1] - sums[i]), 0.0, 1.0);
  return i;
}

}  // namespace

SkySampler::SkySampler(const SkyMap& map)
    : map_(map),
      rows_(static_cast<std::size_t>(map.height()) + 1),
      columns_(static_cast<std::size_t>(map.height()) * (static_cast<std::size_t>(map.width()) + 1)) {
  const int width = map.width();
  for (int y = 0; y < map.height(); ++y) {
    double* const row = &columns_[static_cast<std::size_t>(y) * (static_cast<std::size_t>(width) + 1)];
    for (int x = 0; x < width; ++x) row[x + 1] = mean_luminance(map, x, y);
    const double band = border_cosine(map, y) - border_cosine(map, y + 1);
    rows_[static_cast<std::size_t>(y) + 1] = band * accumulate(row, width);
  }
  accumulate(rows_.data(), map.height());
}

double SkySampler::texel_pdf(int x, int y) const {
  const double* const row =
      &columns_[static_cast<std::size_t>(y) * (static_cast<std::size_t>(map_.width()) + 1)];
  const auto r = static_cast<std::size_t>(y);
  const double share = (rows_[r + 1] - rows_[r]) * (row[x + 1] - row[x]);
  return share * map_.width() / (2.0 * half_turn * (border_cosine(map_, y) - border_cosine(map_, y + 1)));
}

SkySampler::Sample SkySampler::sample(Pair s) const {
  if (!(rows_.back() > 0.0)) return {};
  double down = 0.0;
  double along = 0.0;
  const int y = find(rows_.data(), map_.height(), static_cast<double>(s.v), down);
  const double* const row =
      &columns_[static_cast<std::size_t>(y) * (static_cast<std::size_t>(map_.width()) + 1)];
  const int x = find(row, map_.width(), static_cast<double>(s.u), along);
  const double top = border_cosine(map_, y);
  const double cosine = top + down * (border_cosine(map_, y + 1) - top);
  const double v = std::acos(std::clamp(cosine, -1.0, 1.0)) / half_turn;
  return {map_.direction((x + along) / map_.width(), v), static_cast<float>(texel_pdf(x, y))};
}

float SkySampler::pdf(const Vec3& direction) const {
  const Vec2 at = map_.place(direction);
  const int x = std::min(static_cast<int>(at.x() * static_cast<float>(map_.width())), map_.width() - 1);
  const int y = std::min(static_cast<int>(at.y() * static_cast<float>(map_.height())), map_.height() - 1);
  return static_cast<float>(texel_pdf(x, y));
}

}  // namespace lagomorph::render::path
