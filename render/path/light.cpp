#include "render/path/light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lagomorph::render::path {

RectangleLight::RectangleLight(const AreaLight& light)
    : center_(light.position),
      width_(light.size.x()),
      height_(light.size.y()),
      radiance_(light.color * light.radiance),
      visible_(light.visible) {
  const LightFrame frame = light_frame(light);
  u_ = frame.right;
  v_ = frame.up;
  normal_ = frame.normal;
}

float RectangleLight::power() const {
  return width_ * height_ * (0.2126F * radiance_.x() + 0.7152F * radiance_.y() + 0.0722F * radiance_.z());
}

/// The rectangle in the frame (u, v, -normal) around p: x0..x1, y0..y1 at distance z0 > 0.
struct RectangleLight::View {
  float x0, x1, y0, y1, z0;
  bool small;  // sample by area
  float b0, b1,
      k;  // [Ureña 2013]: cosines of the normals of the sides y0 and y1, 2 pi minus two inner angles
  float solid_angle;  // [sr]
};

RectangleLight::View RectangleLight::view_from(const Vec3& p) const {
  View s{};
  const Vec3 d = center_ - p;
  const float x = d.dot(u_);
  const float y = d.dot(v_);
  s.x0 = x - 0.5F * width_;
  s.x1 = x + 0.5F * width_;
  s.y0 = y - 0.5F * height_;
  s.y1 = y + 0.5F * height_;
  s.z0 = -d.dot(normal_);
  // Seen under a third of a radian or so, cos / r^2 is nearly constant and the angles lose their digits.
  s.small = width_ * width_ + height_ * height_ < 0.1F * d.squaredNorm();
  if (s.small || s.z0 <= 0.0F) return s;
  const float z2 = s.z0 * s.z0;
  s.b0 = -s.y0 / std::sqrt(z2 + s.y0 * s.y0);
  const float n1 = s.x1 / std::sqrt(z2 + s.x1 * s.x1);
  s.b1 = s.y1 / std::sqrt(z2 + s.y1 * s.y1);
  const float n3 = -s.x0 / std::sqrt(z2 + s.x0 * s.x0);
  s.k = 2.0F * std::numbers::pi_v<float> - std::acos(-s.b1 * n3) - std::acos(-n3 * s.b0);
  s.solid_angle = std::max(std::acos(-s.b0 * n1) + std::acos(-n1 * s.b1) - s.k, 1e-6F);
  return s;
}

/// Density in solid angle of a uniform density over the area: r^2 / (cos area).
float RectangleLight::area_to_solid_angle(const Vec3& to_point) const {
  const float r2 = to_point.squaredNorm();
  const float cosine = -to_point.dot(normal_) / std::sqrt(r2);
  return cosine > 0.0F ? r2 / (cosine * width_ * height_) : 0.0F;
}

RectangleLight::Sample RectangleLight::sample(const Vec3& p, Pair s) const {
  const View view = view_from(p);
  if (view.z0 <= 0.0F) return {};
  float x = 0.0F;
  float y = 0.0F;
  if (view.small) {
    x = view.x0 + s.u * width_;
    y = view.y0 + s.v * height_;
  } else {
    const float a = s.u * view.solid_angle + view.k;
    const float f = (std::cos(a) * view.b0 - view.b1) / std::sin(a);
    const float c =
        std::clamp(std::copysign(1.0F / std::sqrt(f * f + view.b0 * view.b0), f), -0.9999999F, 0.9999999F);
    x = std::clamp(c * view.z0 / std::sqrt(1.0F - c * c), view.x0, view.x1);
    const float d2 = x * x + view.z0 * view.z0;
    const float h0 = view.y0 / std::sqrt(d2 + view.y0 * view.y0);
    const float h1 = view.y1 / std::sqrt(d2 + view.y1 * view.y1);
    const float h = h0 + s.v * (h1 - h0);
    y = std::clamp(h * std::sqrt(d2 / std::max(1.0F - h * h, 1e-7F)), view.y0, view.y1);
  }
  const Vec3 to_point = x * u_ + y * v_ - view.z0 * normal_;
  const float distance = to_point.norm();
  return {to_point / distance, distance,
          view.small ? area_to_solid_angle(to_point) : 1.0F / view.solid_angle};
}

RectangleLight::Hit RectangleLight::intersect(const Ray& ray) const {
  const float approach = -ray.direction.dot(normal_);
  if (approach <= 0.0F) return {};
  const float t = (ray.origin - center_).dot(normal_) / approach;
  if (!(t > 0.0F)) return {};
  const Vec3 point = ray.origin + t * ray.direction;
  const Vec3 d = point - center_;
  if (std::abs(d.dot(u_)) > 0.5F * width_ || std::abs(d.dot(v_)) > 0.5F * height_) return {};
  return {t, point};
}

float RectangleLight::pdf(const Vec3& p, const Vec3& point) const {
  const View view = view_from(p);
  if (view.z0 <= 0.0F) return 0.0F;
  return view.small ? area_to_solid_angle(point - p) : 1.0F / view.solid_angle;
}

}  // namespace lagomorph::render::path
