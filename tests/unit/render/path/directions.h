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

constexpr int sphere_rings = 800;
constexpr int sphere_spokes = 400;
constexpr double sphere_weight() { return 4.0 * std::numbers::pi / (sphere_rings * sphere_spokes); }

/// Integral over all directions by the midpoint rule, in cosine and azimuth.
template <class F>
double sphere(const F& f) {
  double sum = 0.0;
  for (int i = 0; i < sphere_rings; ++i) {
    for (int j = 0; j < sphere_spokes; ++j) {
      const double cosine = 2.0 * (i + 0.5) / sphere_rings - 1.0;
      sum += f(direction(cosine, 2.0 * std::numbers::pi * (j + 0.5) / sphere_spokes));
    }
  }
  return sum * sphere_weight();
}

}  // namespace lagomorph::render::path
