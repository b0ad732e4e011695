#include "render/path/lens.h"

#include <algorithm>
#include <cmath>

#include "render/path/microfacet.h"

namespace lagomorph::render::path {
namespace {

Vec2 on_disc(Pair s) {
  const float a = 2.0F * s.u - 1.0F;
  const float b = 2.0F * s.v - 1.0F;
  if (a == 0.0F && b == 0.0F) return Vec2::Zero();
  const bool flat = std::abs(a) > std::abs(b);
  const float r = flat ? a : b;
  const float phi = flat ? pi / 4.0F * (b / a) : pi / 2.0F - pi / 4.0F * (a / b);
  return {r * std::cos(phi), r * std::sin(phi)};
}

}  // namespace

Aperture::Aperture(const Camera& camera)
    : blades_(camera.blades()), rotation_(camera.blade_rotation() * pi / 180.0F) {}

Vec2 Aperture::point(Pair s) const {
  if (blades_ == 0) return on_disc(s);
  const float along = s.u * static_cast<float>(blades_);
  const int k = std::min(static_cast<int>(along), blades_ - 1);
  const float a = rotation_ + 2.0F * pi * static_cast<float>(k) / static_cast<float>(blades_);
  const float b = rotation_ + 2.0F * pi * static_cast<float>(k + 1) / static_cast<float>(blades_);
  // Between the k-th side's ends at a fraction, then from the middle outwards as the square root.
  const float f = along - static_cast<float>(k);
  const Vec2 side = (1.0F - f) * Vec2(std::cos(a), std::sin(a)) + f * Vec2(std::cos(b), std::sin(b));
  return std::sqrt(s.v) * side;
}

}  // namespace lagomorph::render::path
