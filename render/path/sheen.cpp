#include "render/path/sheen.h"

#include <algorithm>
#include <cmath>

#include "render/path/microfacet.h"

namespace lagomorph::render::path {
Sheen::Sheen(float roughness) : power_(1.0F / std::max(roughness * roughness, 0.01F)), scale_(1.0F) {
  constexpr int rings = 64;
  constexpr int spokes = 64;  // over half a turn
  for (int i = 0; i <= intervals; ++i) {
    const float c = std::max(static_cast<float>(i) / intervals, 1e-3F);
    const Vec3 wo(std::sqrt(1.0F - c * c), 0.0F, c);
    double sum = 0.0;
    for (int ring = 0; ring < rings; ++ring) {
      // Finer near the horizon: the cosine is a square.
      const float x = (static_cast<float>(ring) + 0.5F) / rings;
      const float cosine = x * x;
      const float sine = std::sqrt(1.0F - cosine * cosine);
      for (int spoke = 0; spoke < spokes; ++spoke) {
        const float phi = pi * (static_cast<float>(spoke) + 0.5F) / spokes;
        const Vec3 wi(sine * std::cos(phi), sine * std::sin(phi), cosine);
        sum += static_cast<double>(evaluate(wo, wi)) * cosine * 2.0 * x;
      }
    }
    albedo_[i] = static_cast<float>(sum * 2.0 * pi / (static_cast<double>(rings) * spokes));
  }
  const float most = *std::max_element(albedo_.begin(), albedo_.end());
  if (most <= 1.0F) return;
  scale_ = 1.0F / most;
  for (float& a : albedo_) a *= scale_;
}

float Sheen::evaluate(const Vec3& wo, const Vec3& wi) const {
  if (wo.z() <= 0.0F || wi.z() <= 0.0F) return 0.0F;
  const Vec3 h = (wo + wi).normalized();
  const float sine2 = std::max(1.0F - h.z() * h.z(), 0.0F);
  const float d = (2.0F + power_) * std::pow(sine2, 0.5F * power_) / (2.0F * pi);
  return scale_ * d / (4.0F * (wo.z() + wi.z() - wo.z() * wi.z()));
}

float Sheen::albedo(float cosine) const {
  const float x = std::clamp(cosine, 0.0F, 0x1.fffffep-1F) * intervals;
  const int i = static_cast<int>(x);
  return albedo_[i] + (x - static_cast<float>(i)) * (albedo_[i + 1] - albedo_[i]);
}

}  // namespace lagomorph::render::path
