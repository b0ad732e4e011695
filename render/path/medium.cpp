#include "render/path/medium.h"

#include <algorithm>
#include <cmath>

namespace lagomorph::render::path {

Absorption::Absorption(const Material& m)
    : coefficient_(-m.absorption_color.max(1e-6F).log() / m.absorption_distance),
      is_clear_(m.absorption_color.minCoeff() >= 1.0F) {}

CloudyInside::CloudyInside(const Material& m) : extinction(m.subsurface_radius.inverse()) {
  for (int k = 0; k < 3; ++k) albedo[k] = scattering_albedo(m.subsurface_color[k]);
}

float scattering_albedo(float reflectance) {
  // 0.139 s^2 - (1.139 + 1.17 A) s + 1 - A = 0, the lesser root without cancellation.
  const double a = std::clamp(static_cast<double>(reflectance), 0.0, 1.0);
  const double b = 1.139 + 1.17 * a;
  const double s = 2.0 * (1.0 - a) / (b + std::sqrt(b * b - 4.0 * 0.139 * (1.0 - a)));
  return static_cast<float>(1.0 - s * s);
}

}  // namespace lagomorph::render::path
