#include "render/path/filter.h"

#include <cmath>
#include <numbers>

#include "render/error.h"

namespace lagomorph::render::path {
namespace {

// Filters on x in [-1, 1], not normalized.

double box(double) { return 1.0; }

/// A standard deviation of a third of the radius.
double gaussian(double x) { return std::exp(-4.5 * x * x); }

/// The four-term window [Harris 1978], -92 dB.
double blackman_harris(double x) {
  const double t = std::numbers::pi * x;
  return 0.35875 + 0.48829 * std::cos(t) + 0.14128 * std::cos(2.0 * t) + 0.01168 * std::cos(3.0 * t);
}

struct NamedFilter {
  const char* name;
  double (*value)(double);
};
constexpr NamedFilter filters[] = {
    {"box", box}, {"gaussian", gaussian}, {"blackman_harris", blackman_harris}};

const NamedFilter& find_filter(std::string_view name) {
  for (const NamedFilter& row : filters) {
    if (name == row.name) return row;
  }
  std::string known;
  for (const NamedFilter& row : filters) known += std::string(known.empty() ? "" : ", ") + row.name;
  throw SettingsError("render.path.filter: unknown filter '" + std::string(name) + "'; known are " + known);
}

}  // namespace

std::vector<std::string> filter_names() {
  std::vector<std::string> names;
  for (const NamedFilter& row : filters) names.emplace_back(row.name);
  return names;
}

PixelFilter::PixelFilter(std::string_view name, float radius) {
  const NamedFilter& filter = find_filter(name);
  if (!(radius > 0.0F && radius <= 4.0F)) {
    throw SettingsError("render.path.filter_radius = " + std::to_string(radius) +
                        " must be in (0, 4] pixels");
  }
  constexpr int steps = 65536;
  const auto value = [&](int i) { return filter.value((i + 0.5) / steps * 2.0 - 1.0); };
  double total = 0.0;
  for (int i = 0; i < steps; ++i) total += value(i);
  // Walk the cumulative sum and note where it passes each multiple of 1 / intervals.
  double below = 0.0;
  std::size_t k = 0;
  for (int i = 0; i < steps; ++i) {
    const double next = below + value(i) / total;
    while (k < intervals && static_cast<double>(k) / intervals <= next) {
      const double within = (static_cast<double>(k) / intervals - below) / (next - below);
      inverse_[k++] = static_cast<float>(radius * ((i + within) / steps * 2.0 - 1.0));
    }
    below = next;
  }
  inverse_[intervals] = radius;
}

}  // namespace lagomorph::render::path
