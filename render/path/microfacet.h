#pragma once

#include <numbers>

#include "render/types.h"

/// What the microfacet models have in common. Directions in the surface's frame, z along the normal.
namespace lagomorph::render::path {

inline constexpr float pi = std::numbers::pi_v<float>;
inline constexpr float inv_pi = std::numbers::inv_pi_v<float>;

/// Isotropic GGX distribution of the normals h [Walter et al. 2007, Eq. 33]. [1/sr]
inline float ggx(const Vec3& h, float alpha) {
  const float a2 = alpha * alpha;
  const float k = (h.x() * h.x() + h.y() * h.y()) / a2 + h.z() * h.z();
  return inv_pi / (a2 * k * k);
}

/// On the other side of the surface.
inline Vec3 mirrored(const Vec3& w) { return {w.x(), w.y(), -w.z()}; }

}  // namespace lagomorph::render::path
