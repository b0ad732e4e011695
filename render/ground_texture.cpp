#include "render/ground_texture.h"

#include <algorithm>
#include <cmath>

namespace lagomorph::render {
namespace {

constexpr double wide = 3.0;  // lines at whole metres, over the others

/// Distance to the nearest multiple of `step`.
double from_line(double x, double step) { return std::abs(x - step * std::round(x / step)); }

bool is_on_line(double x, const Ground& g) {
  const double half = 0.5 * static_cast<double>(g.line_width);
  return from_line(x, static_cast<double>(g.texture_size)) <= half || from_line(x, 1.0) <= wide * half;
}

}  // namespace

std::vector<std::string> ground_texture_names() { return {"none", "checker", "grid"}; }

float ground_texture_at(const Ground& g, const Vec3& point) {
  const double x = point.x(), z = point.z(), size = g.texture_size;
  if (g.texture == "checker") {
    const auto squares =
        static_cast<long long>(std::floor(x / size)) + static_cast<long long>(std::floor(z / size));
    return squares % 2 == 0 ? 0.0F : 1.0F;
  }
  return g.texture == "grid" && (is_on_line(x, g) || is_on_line(z, g)) ? 1.0F : 0.0F;
}

Color ground_color_at(const Ground& g, const Vec3& point) {
  const float part = ground_texture_at(g, point);
  return (1.0F - part) * g.material.base_color + part * g.texture_color;
}

}  // namespace lagomorph::render
