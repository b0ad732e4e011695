#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace lagomorph::render::path {

std::vector<std::string> filter_names();

/// Pixel reconstruction by importance sampling of the filter [Ernst, Stamminger and Greiner 2006]: a sample
/// falls at a distance from its pixel's centre that is distributed as the (separable, positive) filter, and
/// weighs 1. So every sample belongs to one pixel.
class PixelFilter {
public:
  /// `radius` in pixels. Throws SettingsError for an unknown name (listing the names) or a radius outside (0,
  /// 4].
  PixelFilter(std::string_view name, float radius);
  /// Distance from the pixel's centre along one axis for a number in [0, 1) [pixels].
  float offset(float u) const {
    const float x = u * static_cast<float>(intervals);
    const auto i = static_cast<std::size_t>(x);
    return inverse_[i] + (x - static_cast<float>(i)) * (inverse_[i + 1] - inverse_[i]);
  }

private:
  static constexpr std::size_t intervals = 1024;
  std::array<float, intervals + 1> inverse_{};  // of the cumulative distribution
};

}  // namespace lagomorph::render::path
