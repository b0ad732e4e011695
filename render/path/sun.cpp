#include "render/path/sun.h"

#include <cmath>
#include <numbers>

namespace lagomorph::render::path {

SunLight::SunLight(const Sun& sun) : visible_(sun.visible) {
  const Vec3 middle = -sun.direction.normalized();
  const Frame frame = frame_of(f3(middle));
  // 1 - cos by the half angle: a small sun's cosine is 1 to rounding.
  const double half = static_cast<double>(sun.angle) * std::numbers::pi / 360.0;
  const double chord = 2.0 * std::sin(half / 2.0);
  const double sine = std::sin(half);
  chord2_ = static_cast<float>(chord * chord);
  const Color irradiance = sun.irradiance * sun.color;
  const Color radiance = irradiance * static_cast<float>(1.0 / (std::numbers::pi * sine * sine));
  disc_ = {f3(middle),
           frame.t,
           frame.b,
           static_cast<float>(chord * chord / 2.0),
           static_cast<float>(1.0 / (std::numbers::pi * chord * chord)),
           f3(radiance)};
  strength_ = luminance(f3(irradiance));
}

Vec3 SunLight::sample(Pair s) const { return vec3(sun_direction(disc_, s.u, s.v)); }

}  // namespace lagomorph::render::path
