#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "render/simd.h"
#include "render/types.h"

/// Arithmetic without branches or calls, so that loops over rows of floats which use it become vector code.
/// The formulas that stand on it are written once, for one lane, and serve single paths too.
namespace lagomorph::render::path {

struct F3 {
  float x, y, z;
};

LAGOMORPH_INLINE F3 f3(const Vec3& a) { return {a.x(), a.y(), a.z()}; }
LAGOMORPH_INLINE F3 f3(const Color& a) { return {a.x(), a.y(), a.z()}; }
inline Vec3 vec3(const F3& a) { return {a.x, a.y, a.z}; }
inline Color color(const F3& a) { return {a.x, a.y, a.z}; }

LAGOMORPH_INLINE F3 operator+(F3 a, F3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
LAGOMORPH_INLINE F3 operator-(F3 a, F3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
LAGOMORPH_INLINE F3 operator-(F3 a) { return {-a.x, -a.y, -a.z}; }
LAGOMORPH_INLINE F3 operator*(F3 a, F3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
LAGOMORPH_INLINE F3 operator*(float s, F3 a) { return {s * a.x, s * a.y, s * a.z}; }
LAGOMORPH_INLINE float dot(F3 a, F3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
LAGOMORPH_INLINE F3 normalized(F3 a) { return (1.0F / std::sqrt(dot(a, a))) * a; }
LAGOMORPH_INLINE float max_of(F3 a) { return std::max(std::max(a.x, a.y), a.z); }
LAGOMORPH_INLINE F3 select(bool which, F3 a, F3 b) {
  return {which ? a.x : b.x, which ? a.y : b.y, which ? a.z : b.z};
}
LAGOMORPH_INLINE float luminance(F3 c) { return 0.2126F * c.x + 0.7152F * c.y + 0.0722F * c.z; }

/// All of them, without a branch.
LAGOMORPH_INLINE bool all_of(bool a, bool b) { return (static_cast<int>(a) & static_cast<int>(b)) != 0; }
LAGOMORPH_INLINE bool all_of(bool a, bool b, bool c) { return all_of(all_of(a, b), c); }
struct SinCos {
  float sine, cosine;
};
/// Of an angle in turns, in [0, 2^20), to 1e-7. The polynomials on +-pi/4 are those of [Cephes, sinf].
LAGOMORPH_INLINE SinCos sincos_of_turns(float turns) {
  // NOLINTNEXTLINE(bugprone-incorrect-roundings): no turn is negative, and lround would be a call a lane
  const auto quarter = static_cast<std::int32_t>(turns * 4.0F + 0.5F);
  const float x = (turns - 0.25F * static_cast<float>(quarter)) * (2.0F * std::numbers::pi_v<float>);
  const float z = x * x;
  const float s = ((-1.9515295891e-4F * z + 8.3321608736e-3F) * z - 1.6666654611e-1F) * z * x + x;
  const float c = ((2.443315711809948e-5F * z - 1.388731625493765e-3F) * z + 4.166664568298827e-2F) * z * z -
                  0.5F * z + 1.0F;
  const bool odd = (quarter & 1) != 0;
  const float sine = odd ? c : s;
  const float cosine = odd ? s : c;
  return {(quarter & 2) != 0 ? -sine : sine, ((quarter + 1) & 2) != 0 ? -cosine : cosine};
}

/// In [0, pi], of x in [-1, 1], to 3e-7 [Cephes, asinf].
LAGOMORPH_INLINE float arc_cosine(float x) {
  const float a = std::abs(x);
  const bool near_end = a > 0.5F;
  const float half = 0.5F * (1.0F - a);
  const float s = near_end ? std::sqrt(std::max(half, 0.0F)) : a;
  const float z = s * s;
  const float arc =
      ((((4.2163199048e-2F * z + 2.4181311049e-2F) * z + 4.5470025998e-2F) * z + 7.4953002686e-2F) * z +
       1.6666752422e-1F) *
          z * s +
      s;
  constexpr float pi = std::numbers::pi_v<float>;
  const float of_abs = near_end ? 2.0F * arc : 0.5F * pi - arc;
  return x < 0.0F ? pi - of_abs : of_abs;
}

struct Frame {
  F3 t, b;
};
/// Tangents t and b so that (t, b, n) is a right-handed frame [Duff et al. 2017].
LAGOMORPH_INLINE Frame frame_of(F3 n) {
  const float sign = std::copysign(1.0F, n.z);
  const float a = -1.0F / (sign + n.z);
  const float c = n.x * n.y * a;
  return {{1.0F + sign * n.x * n.x * a, sign * c, -sign * n.x}, {c, sign + n.y * n.y * a, -n.y}};
}

/// p moved off its surface along the unit normal n by some 256 units in the last place [Wächter and Binder
/// 2019].
LAGOMORPH_INLINE float offset_along(float p, float n) {
  const auto steps = static_cast<std::int32_t>(256.0F * n);
  const auto bits = std::bit_cast<std::int32_t>(p);
  const auto by_bits = std::bit_cast<float>(bits + (p < 0.0F ? -steps : steps));
  return std::abs(p) < 1.0F / 32.0F ? p + n / 65536.0F : by_bits;
}

}  // namespace lagomorph::render::path
