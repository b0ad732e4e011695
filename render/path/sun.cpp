#include "render/path/sun.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/path/brdf.h"

namespace lagomorph::render::path {

SunLight::SunLight(const Sun& sun) : middle_(-sun.direction.normalized()), visible_(sun.visible) {
  make_frame(middle_, t_, b_);
  // 1 - cos by the half angle: a small sun's cosine is 1 to rounding.
  const double half = static_cast<double>(sun.angle) * std::numbers::pi / 360.0;
  const double chord = 2.0 * std::sin(half / 2.0);
  const double sine = std::sin(half);
  height_ = static_cast<float>(chord * chord / 2.0);
  chord2_ = static_cast<float>(chord * chord);
  pdf_ = static_cast<float>(1.0 / (std::numbers::pi * chord * chord));
  const Color irradiance = sun.irradiance * sun.color;
  radiance_ = irradiance * static_cast<float>(1.0 / (std::numbers::pi * sine * sine));
  strength_ = 0.2126F * irradiance.x() + 0.7152F * irradiance.y() + 0.0722F * irradiance.z();
}

Vec3 SunLight::sample(Pair s) const {
  const float below = s.u * height_;  // 1 - cos
  const float across = std::sqrt(std::max(below * (2.0F - below), 0.0F));
  const float phi = 2.0F * std::numbers::pi_v<float> * s.v;
  return (across * (std::cos(phi) * t_ + std::sin(phi) * b_) + (1.0F - below) * middle_).normalized();
}

}  // namespace lagomorph::render::path
