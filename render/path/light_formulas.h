#pragma once

#include "render/path/lane_math.h"

/// The formulas of RectangleLight for one lane; light.h says what they mean.
namespace lagomorph::render::path {

struct Rectangle {
  F3 center, u, v, normal;  // u, v: unit axes along width and height; the normal is the shining side
  float width, height;
};

/// The rectangle in the frame (u, v, -normal) around p: x0..x1, y0..y1 at distance z0, > 0 where it shines.
struct RectangleView {
  float x0, x1, y0, y1, z0;
  bool small;  // sample by area
  float b0, b1,
      k;  // [Ureña 2013]: cosines of the normals of the sides y0 and y1, 2 pi minus two inner angles
  float solid_angle;  // [sr]
};

LAGOMORPH_INLINE RectangleView view_from(const Rectangle& r, F3 p) {
  RectangleView s;
  const F3 d = r.center - p;
  const float x = dot(d, r.u);
  const float y = dot(d, r.v);
  s.x0 = x - 0.5F * r.width;
  s.x1 = x + 0.5F * r.width;
  s.y0 = y - 0.5F * r.height;
  s.y1 = y + 0.5F * r.height;
  s.z0 = -dot(d, r.normal);
  // Seen under a third of a radian or so, cos / r^2 is nearly constant and the angles lose their digits.
  s.small = r.width * r.width + r.height * r.height < 0.1F * dot(d, d);
  const float z2 = s.z0 * s.z0;
  s.b0 = -s.y0 / std::sqrt(z2 + s.y0 * s.y0);
  const float n1 = s.x1 / std::sqrt(z2 + s.x1 * s.x1);
  s.b1 = s.y1 / std::sqrt(z2 + s.y1 * s.y1);
  const float n3 = -s.x0 / std::sqrt(z2 + s.x0 * s.x0);
  s.k = 2.0F * std::numbers::pi_v<float> - arc_cosine(-s.b1 * n3) - arc_cosine(-n3 * s.b0);
  s.solid_angle = std::max(arc_cosine(-s.b0 * n1) + arc_cosine(-n1 * s.b1) - s.k, 1e-6F);
  return s;
}

/// Density in solid angle of a uniform density over the area: r^2 / (cos area).
LAGOMORPH_INLINE float area_to_solid_angle(const Rectangle& r, F3 to_point) {
  const float r2 = dot(to_point, to_point);
  const float cosine = -dot(to_point, r.normal) / std::sqrt(r2);
  return cosine > 0.0F ? r2 / (cosine * r.width * r.height) : 0.0F;
}

struct LightSample {
  F3 direction;
  float distance;  // [m]
  float pdf;  // of the direction [1/sr]; 0 where the light does not shine, and then the rest means nothing
};
LAGOMORPH_INLINE LightSample sample_rectangle(const Rectangle& r, F3 p, float u, float v) {
  const RectangleView view = view_from(r, p);
  // Around [Ureña, Fajardo and King 2013].
  constexpr float in_turns = 0.5F * std::numbers::inv_pi_v<float>;
  const SinCos a = sincos_of_turns(std::max((u * view.solid_angle + view.k) * in_turns, 0.0F));
  const float f = (a.cosine * view.b0 - view.b1) / a.sine;
  const float c = std::min(
      std::max(std::copysign(1.0F / std::sqrt(f * f + view.b0 * view.b0), f), -0.9999999F), 0.9999999F);
  const float across = std::min(std::max(c * view.z0 / std::sqrt(1.0F - c * c), view.x0), view.x1);
  const float d2 = across * across + view.z0 * view.z0;
  const float h0 = view.y0 / std::sqrt(d2 + view.y0 * view.y0);
  const float h1 = view.y1 / std::sqrt(d2 + view.y1 * view.y1);
  const float h = h0 + v * (h1 - h0);
  const float up = std::min(std::max(h * std::sqrt(d2 / std::max(1.0F - h * h, 1e-7F)), view.y0), view.y1);
  const float x = view.small ? view.x0 + u * r.width : across;
  const float y = view.small ? view.y0 + v * r.height : up;
  const F3 to_point = x * r.u + y * r.v - view.z0 * r.normal;
  const float distance = std::sqrt(dot(to_point, to_point));
  const float pdf = view.small ? area_to_solid_angle(r, to_point) : 1.0F / view.solid_angle;
  return {(1.0F / distance) * to_point, distance, view.z0 > 0.0F ? pdf : 0.0F};
}

/// Distance [m] at which a ray meets the shining side; 0: it does not.
LAGOMORPH_INLINE float meet_rectangle(const Rectangle& r, F3 origin, F3 direction) {
  const float approach = -dot(direction, r.normal);
  const float t = dot(origin - r.center, r.normal) / approach;
  const F3 d = origin + t * direction - r.center;
  const bool within =
      all_of(std::abs(dot(d, r.u)) <= 0.5F * r.width, std::abs(dot(d, r.v)) <= 0.5F * r.height);
  return all_of(all_of(approach > 0.0F, t > 0.0F), within) ? t : 0.0F;
}

/// A cone of directions around the unit vector `middle`, of one radiance.
struct SunDisc {
  F3 middle, t, b;
  float height;  // 1 - cos of half its angle
  float pdf;     // of its directions [1/sr]
  F3 radiance;
};
LAGOMORPH_INLINE F3 sun_direction(const SunDisc& sun, float u, float v) {
  const float below = u * sun.height;  // 1 - cos
  const float across = std::sqrt(std::max(below * (2.0F - below), 0.0F));
  const SinCos phi = sincos_of_turns(v);
  return normalized(across * (phi.cosine * sun.t + phi.sine * sun.b) + (1.0F - below) * sun.middle);
}

/// Power heuristic for one sample of each of two ways [Veach 1997, Eq. 9.13].
LAGOMORPH_INLINE float power_heuristic(float pdf, float other) {
  const float a = pdf * pdf;
  return a / (a + other * other);
}

/// A sky without a map: its radiance between two colours, up to straight above.
struct SkyGradient {
  F3 horizon, zenith;
};
LAGOMORPH_INLINE F3 sky_gradient(const SkyGradient& sky, F3 direction) {
  const float w = std::sqrt(std::max(direction.y, 0.0F));
  return (1.0F - w) * sky.horizon + w * sky.zenith;
}

}  // namespace lagomorph::render::path
