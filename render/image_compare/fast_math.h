#pragma once

#include <bit>
#include <cstdint>

#include "render/image_compare/lanes.h"

/// Powers and roots without branches or tables, so that a loop over a row of them becomes vector code.
namespace lagomorph::render {

/// Cube root of a positive normal number, to 2e-7 of itself: a first guess from the exponent, then Halley's
/// and Newton's iterations.
LAGOMORPH_INLINE float fast_cbrt(float x) {
  // A third of the exponent, with its bias, and so much less that the guess is within 3.5 % on both sides.
  constexpr auto bias = static_cast<std::int32_t>((127.0 - 127.0 / 3.0 - 0.0331) * (1 << 23));
  const auto third =
      static_cast<std::int32_t>(static_cast<float>(std::bit_cast<std::int32_t>(x)) * (1.0F / 3.0F));
  float y = std::bit_cast<float>(third + bias);
  const float cube = y * y * y;
  y = y * (cube + (x + x)) / ((cube + cube) + x);
  return y - (y - x / (y * y)) * (1.0F / 3.0F);
}

/// Binary logarithm of a positive normal number, to 1e-7 of the larger of itself and 1: the exponent and
/// 2 artanh(t) / ln 2 with t = (m - 1) / (m + 1), the mantissa m in [sqrt(1/2), sqrt(2)).
LAGOMORPH_INLINE float fast_log2(float x) {
  constexpr std::int32_t root_half = 0x3F3504F3;
  const std::int32_t bits = std::bit_cast<std::int32_t>(x) - root_half;
  const auto exponent = static_cast<float>(bits >> 23);
  const float m = std::bit_cast<float>((bits & 0x007FFFFF) + root_half);
  const float t = (m - 1.0F) / (m + 1.0F);
  const float t2 = t * t;
  // 2 / ((2 k + 1) ln 2)
  const float series =
      2.8853901F + t2 * (0.96179669F + t2 * (0.57707802F + t2 * (0.41219858F + t2 * 0.32059890F)));
  return exponent + t * series;
}

/// 2^x for x in [-126, 127], to 2e-7 of itself.
LAGOMORPH_INLINE float fast_exp2(float x) {
  constexpr float round = 12582912.0F;  // 1.5 * 2^23: what is added to it is rounded to an integer
  const float shifted = x + round;
  const float f = (x - (shifted - round)) * 0.69314718F;  // in [-0.35, 0.35]
  const std::int32_t exponent = std::bit_cast<std::int32_t>(shifted) - std::bit_cast<std::int32_t>(round);
  const float taylor =
      1.0F +
      f * (1.0F + f * (0.5F + f * (1.0F / 6.0F +
                                   f * (1.0F / 24.0F +
                                        f * (1.0F / 120.0F + f * (1.0F / 720.0F + f * (1.0F / 5040.0F)))))));
  return std::bit_cast<float>(std::bit_cast<std::int32_t>(taylor) + (exponent << 23));
}

}  // namespace lagomorph::render
