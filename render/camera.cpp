#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "render/error.h"

namespace lagomorph::render {

Camera::Camera(const CameraSettings& s, int width, int height)
    : width_(width),
      height_(height),
      orthographic_(s.orthographic.has_value()),
      position_(s.position),
      blades_(s.blades),
      blade_rotation_(s.blade_rotation) {
  if (width <= 0 || height <= 0) {
    throw SettingsError("picture size " + std::to_string(width) + "x" + std::to_string(height) +
                        " must be positive");
  }
  const Vec3 view = s.look_at - s.position;
  if (!(view.norm() > 0.0F) || !view.allFinite()) {
    throw SettingsError("camera.position and camera.look_at must be finite and differ");
  }
  forward_ = view.normalized();
  const Vec3 side = forward_.cross(s.up);
  if (!(side.norm() > 1e-6F * s.up.norm())) {
    throw SettingsError("camera.up must be finite, not zero and not along the view direction");
  }
  right_ = side.normalized();
  up_ = right_.cross(forward_);
  if (orthographic_) {
    if (!(*s.orthographic > 0.0F)) throw SettingsError("camera.orthographic must be a height above 0 m");
    half_height_ = *s.orthographic / 2.0F;
  } else {
    if (!(s.fov > 0.0F && s.fov < 180.0F)) {
      throw SettingsError("camera.fov " + std::to_string(s.fov) + " must be in (0, 180) degrees");
    }
    half_height_ = std::tan(s.fov * std::numbers::pi_v<float> / 360.0F);
  }
  half_width_ = half_height_ * static_cast<float>(width) / static_cast<float>(height);
  focus_distance_ = s.focus_distance.value_or(view.norm());
  if (!(s.f_stop >= 0.0F)) throw SettingsError("camera.f_stop must be 0, a pinhole, or above");
  if (!(s.sensor_height > 0.0F)) throw SettingsError("camera.sensor_height must be above 0 m");
  if (!(focus_distance_ > 0.0F)) throw SettingsError("camera.focus_distance must be above 0 m");
  if (blades_ != 0 && (blades_ < 3 || blades_ > 64))
    throw SettingsError("camera.blades = " + std::to_string(blades_) + " must be 0, a disc, or in 3..64");
  // The focal length is sensor_height / (2 tan(fov/2)), the diameter that over f_stop.
  if (!orthographic_ && s.f_stop > 0.0F) lens_radius_ = s.sensor_height / (4.0F * half_height_ * s.f_stop);
}

Camera Camera::between(const Camera& a, const Camera& b, float part) {
  if (part >= 1.0F) return b;
  const auto mixed = [part](const auto& x, const auto& y) { return x + part * (y - x); };
  const Vec3 forward = mixed(a.forward_, b.forward_), right = mixed(a.right_, b.right_);
  const Vec3 side = right - right.dot(forward) / forward.squaredNorm() * forward;
  constexpr float least = 1e-3F;  // of a half turn there is nothing between
  if (!(forward.norm() > least && side.norm() > least)) return part < 0.5F ? a : b;
  Camera c = b;
  c.forward_ = forward.normalized();
  c.right_ = side.normalized();
  c.up_ = c.right_.cross(c.forward_);
  c.position_ = mixed(a.position_, b.position_);
  c.half_height_ = mixed(a.half_height_, b.half_height_);
  c.half_width_ = mixed(a.half_width_, b.half_width_);
  c.lens_radius_ = mixed(a.lens_radius_, b.lens_radius_);
  c.focus_distance_ = mixed(a.focus_distance_, b.focus_distance_);
  return c;
}

Camera camera_at(std::span<const Camera> cameras, float time) {
  const std::size_t segments = cameras.size() - 1;
  const float along = time * static_cast<float>(segments);
  const std::size_t k = std::min(static_cast<std::size_t>(along), segments - 1);
  return Camera::between(cameras[k], cameras[k + 1], along - static_cast<float>(k));
}

Ray Camera::ray(float px, float py) const {
  const float x = (2.0F * px / static_cast<float>(width_) - 1.0F) * half_width_;
  const float y = (1.0F - 2.0F * py / static_cast<float>(height_)) * half_height_;
  if (orthographic_) return {position_ + x * right_ + y * up_, forward_};
  return {position_, (x * right_ + y * up_ + forward_).normalized()};
}

Ray Camera::ray(float px, float py, const Vec2& on_lens) const {
  const float x = (2.0F * px / static_cast<float>(width_) - 1.0F) * half_width_;
  const float y = (1.0F - 2.0F * py / static_cast<float>(height_)) * half_height_;
  const Vec3 start = lens_radius_ * (on_lens.x() * right_ + on_lens.y() * up_);
  const Vec3 sharp = focus_distance_ * (x * right_ + y * up_ + forward_);
  return {position_ + start, (sharp - start).normalized()};
}

Mat4 Camera::view() const {
  Mat4 m = Mat4::Identity();
  m.block<1, 3>(0, 0) = right_.transpose();
  m.block<1, 3>(1, 0) = up_.transpose();
  m.block<1, 3>(2, 0) = -forward_.transpose();
  m.block<3, 1>(0, 3) = -(m.block<3, 3>(0, 0) * position_);
  return m;
}

Mat4 Camera::projection(float near, float far) const {
  Mat4 m = Mat4::Zero();
  m(0, 0) = 1.0F / half_width_;
  m(1, 1) = 1.0F / half_height_;
  if (orthographic_) {
    m(2, 2) = -2.0F / (far - near);
    m(2, 3) = -(far + near) / (far - near);
    m(3, 3) = 1.0F;
  } else {
    m(2, 2) = -(far + near) / (far - near);
    m(2, 3) = -2.0F * far * near / (far - near);
    m(3, 2) = -1.0F;
  }
  return m;
}

Vec2 Camera::project(const Vec3& world) const {
  const Vec3 d = world - position_;
  const float scale = orthographic_ ? 1.0F : d.dot(forward_);
  const float x = d.dot(right_) / (scale * half_width_);
  const float y = d.dot(up_) / (scale * half_height_);
  return {(x + 1.0F) / 2.0F * static_cast<float>(width_), (1.0F - y) / 2.0F * static_cast<float>(height_)};
}

float Camera::pixel_size(float depth) const {
  const float height = 2.0F * half_height_ * (orthographic_ ? 1.0F : depth);
  return height / static_cast<float>(height_);
}

}  // namespace lagomorph::render
