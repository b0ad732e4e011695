#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/types.h"

namespace lagomorph::render::path {

inline Vec3 direction(double cosine, double phi) {
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  return Eigen::Vector3d(sine * std::cos(phi), sine * std::sin(phi), cosine).cast<float>();
}

/// Integral over all directions by the midpoint rule, in the two angles: f(direction, its solid angle).
template <class F>
double sphere(const F& f) {
  constexpr int rings = 800;
  constexpr int spokes = 400;
  constexpr double pi = std::numbers::pi;
  double sum = 0.0;
  for (int i = 0; i < rings; ++i) {
    const double theta = pi * (i + 0.5) / rings;
    const double solid_angle = 2.0 * pi * pi / rings / spokes * std::sin(theta);
    for (int j = 0; j < spokes; ++j)
      sum += solid_angle * f(direction(std::cos(theta), 2.0 * pi * (j + 0.5) / spokes), solid_angle);
  }
  return sum;
}

}  // namespace lagomorph::render::path
