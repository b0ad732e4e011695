#include "render/sky_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "render/error.h"

namespace lagomorph::render {
namespace {

using std::numbers::pi;

}  // namespace

SkyMap::SkyMap(int width, int height, std::vector<Color> texels, float rotation)
    : width_(width), height_(height), turn_(rotation / 360.0F), texels_(std::move(texels)) {
  if (width < 1 || height < 1 ||
      texels_.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    throw SettingsError("a sky map of " + std::to_string(width) + "x" + std::to_string(height) + " has " +
                        std::to_string(texels_.size()) + " texels");
  }
  for (std::size_t i = 0; i < texels_.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      if (texels_[i][k] >= 0.0F && std::isfinite(texels_[i][k])) continue;
      throw SettingsError("the sky map's texel (" + std::to_string(i % static_cast<std::size_t>(width)) +
                          ", " + std::to_string(i / static_cast<std::size_t>(width)) + ") has the value " +
                          std::to_string(texels_[i][k]) + "; it must be finite and >= 0");
    }
  }
}

Vec2 SkyMap::place(const Vec3& direction) const {
  const float u = 0.5F + std::atan2(direction.x(), -direction.z()) / (2.0F * std::numbers::pi_v<float>)-turn_;
  const float v = std::acos(std::clamp(direction.y(), -1.0F, 1.0F)) / std::numbers::pi_v<float>;
  return {std::min(u - std::floor(u), 1.0F), v};
}

Vec3 SkyMap::direction(double u, double v) const {
  const double azimuth = 2.0 * pi * (u - 0.5 + static_cast<double>(turn_));
  const double across = std::sin(pi * v);
  return {static_cast<float>(across * std::sin(azimuth)), static_cast<float>(std::cos(pi * v)),
          static_cast<float>(-across * std::cos(azimuth))};
}

Color SkyMap::radiance(const Vec3& direction) const {
  const Vec2 at = place(direction);
  const float x = at.x() * static_cast<float>(width_) - 0.5F;
  const float y =
      std::clamp(at.y() * static_cast<float>(height_) - 0.5F, 0.0F, static_cast<float>(height_ - 1));
  const float left = std::floor(x);
  const int x0 = (static_cast<int>(left) + width_) % width_;
  const int x1 = (x0 + 1) % width_;
  const int y0 = static_cast<int>(y);
  const int y1 = std::min(y0 + 1, height_ - 1);
  const float fx = x - left;
  const float fy = y - static_cast<float>(y0);
  return (1.0F - fy) * ((1.0F - fx) * texel(x0, y0) + fx * texel(x1, y0)) +
         fy * ((1.0F - fx) * texel(x0, y1) + fx * texel(x1, y1));
}

}  // namespace lagomorph::render
