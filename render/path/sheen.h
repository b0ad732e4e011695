#pragma once

#include <array>

#include "render/types.h"

namespace lagomorph::render::path {

/// The sheen of fibres that stand up: f = D / (4 (c_o + c_i - c_o c_i)) with
/// D = (2 + 1/a) sin(theta_h)^(1/a) / (2 pi), a = roughness^2 [Estevez and Kulla 2017; the masking of Neubelt
/// and Pettineo 2013]. Scaled down where it would reflect more than arrives.
class Sheen {
public:
  explicit Sheen(float roughness);

  /// [1/sr]; 0 unless both are above.
  float evaluate(const Vec3& wo, const Vec3& wi) const;
  /// Directional albedo, <= 1.
  float albedo(float cosine) const;
  /// 1 / a, and what f is scaled by.
  float power() const { return power_; }
  float scale() const { return scale_; }

private:
  static constexpr int intervals = 64;
  float power_;  // 1 / a
  float scale_;
  std::array<float, intervals + 1> albedo_;  // at cosines 0 .. 1
};

}  // namespace lagomorph::render::path
