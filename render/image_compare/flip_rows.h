#pragma once

#include <array>
#include <cstddef>

#include "render/image_compare/fast_math.h"
#include "render/image_compare/flip_color.h"
#include "render/image_compare/lanes.h"

/// FLIP's pointwise steps on rows of pixels; flip_color.h is the same in double, a pixel at a time.
namespace lagomorph::render {

struct FlipConstants {
  std::array<std::array<float, 3>, 3> xyz;  // from linear RGB
  std::array<std::array<float, 3>, 3> rgb;
  float knee;
  float below;  // slopes under and over the knee
  float above;
};
const FlipConstants& flip_constants();

LAGOMORPH_INLINE float clamp_01(float v) {
  const float low = v > 0.0F ? v : 0.0F;
  return low < 1.0F ? low : 1.0F;
}

LAGOMORPH_INLINE float magnitude(float v) { return v < 0.0F ? -v : v; }

/// f of CIE L*a*b* [CIE 15].
LAGOMORPH_INLINE float lab_curve(float t) {
  constexpr float delta = 6.0F / 29.0F;
  constexpr float cube = delta * delta * delta;
  const float root = fast_cbrt(t > cube ? t : cube);
  return t > cube ? root : t * (1.0F / (3.0F * delta * delta)) + 4.0F / 29.0F;
}

/// Linear RGB in place to Y/Yn, X/Xn - Y/Yn, Y/Yn - Z/Zn: FLIP's YCxCz without its offset and factors, which
/// cancel.
LAGOMORPH_INLINE void opponent_row(const FlipConstants& k, float* __restrict red, float* __restrict green,
                                   float* __restrict blue, std::size_t count) {
  const auto m = k.xyz;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = m[0][0] * red[i] + m[0][1] * green[i] + m[0][2] * blue[i];
    const float y = m[1][0] * red[i] + m[1][1] * green[i] + m[1][2] * blue[i];
    const float z = m[2][0] * red[i] + m[2][1] * green[i] + m[2][2] * blue[i];
    red[i] = y;
    green[i] = x - y;
    blue[i] = y - z;
  }
}

/// Filtered opponent colours, clamped to linear RGB in [0, 1], to L* and Hunt's a*, b*. In place; the parts
/// of cz are added.
LAGOMORPH_INLINE void lab_row(const FlipConstants& k, float* __restrict y_l, float* __restrict cx_a,
                              float* __restrict cz_b, const float* __restrict cz_2, std::size_t count) {
  const auto xyz = k.xyz;
  const auto rgb = k.rgb;
  for (std::size_t i = 0; i < count; ++i) {
    const float y = y_l[i];
    const float x = y + cx_a[i];
    const float z = y - (cz_b[i] + cz_2[i]);
    const float r = clamp_01(rgb[0][0] * x + rgb[0][1] * y + rgb[0][2] * z);
    const float g = clamp_01(rgb[1][0] * x + rgb[1][1] * y + rgb[1][2] * z);
    const float b = clamp_01(rgb[2][0] * x + rgb[2][1] * y + rgb[2][2] * z);
    const float fx = lab_curve(xyz[0][0] * r + xyz[0][1] * g + xyz[0][2] * b);
    const float fy = lab_curve(xyz[1][0] * r + xyz[1][1] * g + xyz[1][2] * b);
    const float fz = lab_curve(xyz[2][0] * r + xyz[2][1] * g + xyz[2][2] * b);
    const float l = 116.0F * fy - 16.0F;
    y_l[i] = l;
    cx_a[i] = l * (5.0F * (fx - fy));
    cz_b[i] = l * (2.0F * (fy - fz));
  }
}

/// Lengths of gradients, into the first.
LAGOMORPH_INLINE void length_row(float* __restrict x, const float* __restrict y, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) x[i] = __builtin_sqrtf(x[i] * x[i] + y[i] * y[i]);
}

/// Rows that two pictures' pixels are compared by: L*, Hunt's a* and b*, lengths of the features' gradients.
struct FlipLook {
  const float* l;
  const float* a;
  const float* b;
  const float* edge;
  const float* point;
};

/// The color difference to the power of 1 - feature difference [Andersson 2020, Secs. 4.1 to 4.3].
LAGOMORPH_INLINE void flip_row(const FlipConstants& constants, const FlipLook& p, const FlipLook& q,
                               float* __restrict out, std::size_t count) {
  const FlipConstants k = constants;
  constexpr float tiny = 1e-30F;  // has a logarithm
  for (std::size_t i = 0; i < count; ++i) {
    const float da = p.a[i] - q.a[i];
    const float db = p.b[i] - q.b[i];
    const float hyab = magnitude(p.l[i] - q.l[i]) + __builtin_sqrtf(da * da + db * db);
    const float distance = fast_exp2(static_cast<float>(flip::color_exponent) * fast_log2(hyab + tiny));
    const float low = distance * k.below;
    const float high = static_cast<float>(flip::knee_out) + (distance - k.knee) * k.above;
    const float color = distance < k.knee ? low : high;
    const float edge = magnitude(p.edge[i] - q.edge[i]);
    const float point = magnitude(p.point[i] - q.point[i]);
    const float feature = __builtin_sqrtf(0.70710678F * (edge > point ? edge : point));
    const float error = fast_exp2((1.0F - feature) * fast_log2(color));
    out[i] = hyab > 0.0F ? clamp_01(error) : 0.0F;
  }
}

}  // namespace lagomorph::render
