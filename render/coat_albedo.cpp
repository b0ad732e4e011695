#include "render/coat_albedo.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lagomorph::render {

CoatAlbedo coat_albedo(float cos_view, float roughness) {
  // Visible normals of GGX by spherical caps [Dupuy and Benyoub 2023], at a lattice; each weighs G2 / G1.
  const double a = std::max(static_cast<double>(roughness) * roughness, 1e-3);
  const double vz = std::max(static_cast<double>(cos_view), 1e-3);
  const double vx = std::sqrt(std::max(1.0 - vz * vz, 0.0));
  const double root_v = std::sqrt(a * a * vx * vx + vz * vz);
  const double length = std::hypot(a * vx, vz);
  constexpr int samples = 256;
  constexpr double golden_angle = std::numbers::pi * (3.0 - 2.23606797749978969);
  double scale = 0.0;
  double offset = 0.0;
  for (int i = 0; i < samples; ++i) {
    const double phi = golden_angle * i;
    const double z = (1.0 - (i + 0.5) / samples) * (1.0 + vz / length) - vz / length;
    const double radius = std::sqrt(std::max(1.0 - z * z, 0.0));
    double hx = a * (radius * std::cos(phi) + a * vx / length);
    const double hy = a * radius * std::sin(phi);
    double hz = std::max(z + vz / length, 1e-9);
    const double norm = std::sqrt(hx * hx + hy * hy + hz * hz);
    hx /= norm;
    hz /= norm;
    const double vh = vx * hx + vz * hz;
    const double lz = 2.0 * vh * hz - vz;
    if (lz <= 0.0) continue;
    const double root_l = std::sqrt(a * a * (1.0 - lz * lz) + lz * lz);
    // G1 = 2 v / (v + root_v), G2 = 2 v l / (l root_v + v root_l).
    const double weight = lz * (vz + root_v) / (lz * root_v + vz * root_l);
    const double fresnel = std::pow(1.0 - std::min(vh, 1.0), 5.0);
    scale += weight * (1.0 - fresnel);
    offset += weight * fresnel;
  }
  return {static_cast<float>(scale / samples), static_cast<float>(offset / samples)};
}

}  // namespace lagomorph::render
