#pragma once

#include <cmath>

namespace lagomorph::render {

/// IEC 61966-2-1, of values in [0, 1], and its inverse.
inline double srgb_curve(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}
inline double inverse_srgb_curve(double s) {
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

}  // namespace lagomorph::render
