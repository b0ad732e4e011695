#pragma once

#include <optional>

#include "render/types.h"

namespace lagomorph::render {

/// What a scene says of the camera. Lengths in metres.
struct CameraSettings {
  Vec3 position = Vec3(0.0F, 0.8F, 3.0F);
  Vec3 look_at = Vec3(0.0F, 0.5F, 0.0F);
  Vec3 up = Vec3(0.0F, 1.0F, 0.0F);
  float fov = 35.0F;  // vertical field of view [degrees], in (0, 180)
  std::optional<float>
      orthographic;  // height of the view [m]; given, the projection is orthographic and fov is ignored
};

struct Ray {
  Vec3 origin;
  Vec3 direction;  // unit length
};

/// One camera for both back ends: the same object gives the clip matrix and the rays.
/// Right-handed eye space: x right, y up, -z forward. Pixel (0, 0) is the top left one; its centre is at
/// (0.5, 0.5).
class Camera {
public:
  /// Throws SettingsError for a degenerate frame (position = look_at, up along the view, fov outside (0,
  /// 180), a size <= 0).
  Camera(const CameraSettings&, int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  bool is_orthographic() const { return orthographic_; }
  const Vec3& position() const { return position_; }
  const Vec3& right() const { return right_; }
  const Vec3& up() const { return up_; }
  const Vec3& forward() const { return forward_; }

  /// Ray through the point (px, py) of the picture, in pixels from its top left corner.
  Ray ray(float px, float py) const;
  /// World to eye.
  Mat4 view() const;
  /// Eye to clip, OpenGL conventions (z in [-w, w]).
  Mat4 projection(float near, float far) const;
  /// Depth of a world point: metres along the view axis from the camera's plane.
  float depth(const Vec3& world) const { return (world - position_).dot(forward_); }
  /// World point to the picture, in pixels from its top left corner. Meaningless behind a perspective camera.
  Vec2 project(const Vec3& world) const;
  /// Size of a pixel's footprint at a depth [m].
  float pixel_size(float depth) const;

private:
  int width_, height_;
  bool orthographic_;
  Vec3 position_, right_, up_, forward_;
  float half_height_;  // of the view at depth 1 (perspective) or at any depth (orthographic) [m]
  float half_width_;
};

}  // namespace lagomorph::render
