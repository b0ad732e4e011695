#include "render/image_compare/light_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "render/channels.h"
#include "render/image_compare/student_t.h"

namespace lagomorph::render {
namespace {

/// Another order of sums or instruction set moves a mean by some 1e-6 of itself; that is no other light.
constexpr double rounding = 1e-5;

int cells_of(int pixels) { return (pixels + statistics_cell - 1) / statistics_cell; }

/// A mean with the variance of it, and the degrees of freedom of that.
struct Estimate {
  double mean = 0;
  double variance = 0;
  double dof = 0;
  double samples = 0;  // a pixel
};

/// A sliver that few samples have met, or none, tells too little variance. Were both of the same light, the
/// other side's would hold for this one too, falling as 1 / samples or faster: the larger of the two counts.
Estimate not_less_than(Estimate a, const Estimate& other) {
  const double known = other.variance * other.samples / a.samples;
  if (known > a.variance) {
    a.variance = known;
    a.dof = other.dof;
  }
  return a;
}

Estimate estimate(const LightStatistics& s, std::size_t cell, std::size_t channel) {
  const float* v = s.values.data() + cell * statistics_components;
  return {v[channel], v[3 + channel], v[6] - 1.0, v[7]};
}

double variance_of_rounding(double a, double b) {
  const double most = std::max(std::abs(a), std::abs(b));
  return rounding * rounding * most * most;
}

struct Welch {
  double z = 0;
  double p = 1;
};

/// (b - a) / sqrt(va + vb) with the degrees of freedom of Welch and Satterthwaite.
Welch welch(const Estimate& a, const Estimate& b) {
  const double off = b.mean - a.mean;
  if (off == 0.0) return {};
  const double sampled = a.variance + b.variance;
  const double z = off / std::sqrt(sampled + variance_of_rounding(a.mean, b.mean));
  const double squares = a.variance * a.variance / a.dof + b.variance * b.variance / b.dof;
  const double dof = squares > 0.0 ? sampled * sampled / squares : a.dof + b.dof;
  return {z, two_sided_p(z, dof)};
}

struct Tested {
  std::size_t cell;
  Welch result;
};

/// The cells' figures from the tests of all their channels.
void discover(std::vector<Tested>& tests, double level, LightFigures& figures) {
  std::sort(tests.begin(), tests.end(), [](const Tested& a, const Tested& b) {
    if (a.result.p != b.result.p) return a.result.p < b.result.p;
    const double za = std::abs(a.result.z), zb = std::abs(b.result.z);
    return za != zb ? za > zb : a.cell < b.cell;
  });
  const auto m = static_cast<double>(tests.size());
  std::size_t discovered = 0;
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const double adjusted = tests[k].result.p * m / static_cast<double>(k + 1);
    figures.false_discovery = std::min(figures.false_discovery, adjusted);
    if (adjusted < level) discovered = k + 1;
  }
  std::vector<std::size_t> cells;
  for (std::size_t k = 0; k < discovered; ++k) cells.push_back(tests[k].cell);
  std::sort(cells.begin(), cells.end());
  figures.discoveries = static_cast<int>(std::unique(cells.begin(), cells.end()) - cells.begin());
}

}  // namespace

int LightStatistics::columns() const { return cells_of(width); }
int LightStatistics::rows() const { return cells_of(height); }

bool LightStatistics::usable() const {
  return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

LightFigures compare_light(const LightStatistics& first, const LightStatistics& second,
                           const std::vector<std::uint8_t>& mask, double level) {
  LightFigures figures;
  std::vector<Tested> tests;
  std::array<double, 3> sum_first{}, sum_second{}, variance{};
  const auto place = [&](std::size_t cell) {
    const int x = static_cast<int>(cell) % first.columns() * statistics_cell;
    const int y = static_cast<int>(cell) / first.columns() * statistics_cell;
    return Tile{x, y, std::min(statistics_cell, first.width - x),
                std::min(statistics_cell, first.height - y)};
  };
  const auto is_masked = [&](const Tile& t) {
    for (int y = t.y; y < t.y + t.height && !mask.empty(); ++y) {
      const auto row = mask.begin() + static_cast<std::ptrdiff_t>(y) * first.width + t.x;
      if (std::any_of(row, row + t.width, [](std::uint8_t m) { return m != 0; })) return true;
    }
    return false;
  };
  const auto count = static_cast<std::size_t>(first.columns()) * static_cast<std::size_t>(first.rows());
  for (std::size_t cell = 0; cell < count; ++cell) {
    const Tile tile = place(cell);
    if (is_masked(tile)) continue;
    ++figures.cells;
    const double pixels = 1.0 * tile.width * tile.height;
    for (std::size_t c = 0; c < 3; ++c) {
      const Estimate own_a = estimate(first, cell, c), own_b = estimate(second, cell, c);
      const Estimate a = not_less_than(own_a, own_b), b = not_less_than(own_b, own_a);
      tests.push_back({cell, welch(a, b)});
      sum_first[c] += pixels * a.mean;
      sum_second[c] += pixels * b.mean;
      variance[c] += pixels * pixels * (a.variance + b.variance);
    }
  }
  if (tests.empty()) return figures;
  discover(tests, level, figures);
  figures.cell = place(tests.front().cell);
  figures.cell_z = tests.front().result.z;
  for (std::size_t c = 0; c < 3; ++c) {
    const double off = sum_second[c] - sum_first[c];
    if (off == 0.0) continue;
    const double z = off / std::sqrt(variance[c] + variance_of_rounding(sum_first[c], sum_second[c]));
    if (std::abs(z) <= std::abs(figures.global_z)) continue;
    figures.global_z = z;
    figures.global_channel = static_cast<int>(c);
    figures.global_change = off / sum_first[c];
  }
  return figures;
}

}  // namespace lagomorph::render
