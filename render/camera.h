#pragma once

#include <optional>
#include <span>

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
  // A thin lens, of perspective cameras and the path tracer. Its focal length follows from fov and
  // sensor_height.
  float f_stop = 0.0F;           // focal length over the lens' diameter; 0: a pinhole
  float sensor_height = 0.024F;  // [m]
  std::optional<float>
      focus_distance;           // of the plane that is sharp, along the view axis [m]; none: look_at's
  int blades = 0;               // of the aperture, 0 (a disc) or 3 .. 64
  float blade_rotation = 0.0F;  // counterclockwise as the camera sees it [degrees]
  float shutter = 0.0F;         // part of the time between frames that it is open, up to the frame, in [0, 1]

  bool operator==(const CameraSettings&) const = default;
};

struct Ray {
  Vec3 origin;
  Vec3 direction;     // unit length
  float time = 1.0F;  // when, from 0, the shutter opens, to 1, it closes: the frame itself
};

/// One camera for both back ends: the same object gives the clip matrix and the rays.
/// Right-handed eye space: x right, y up, -z forward. Pixel (0, 0) is the top left one; its centre is at
/// (0.5, 0.5).
class Camera {
public:
  /// Throws SettingsError for a degenerate frame (position = look_at, up along the view, fov outside (0,
  /// 180), a size <= 0) and a lens that is none.
  Camera(const CameraSettings&, int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  bool is_orthographic() const { return orthographic_; }
  const Vec3& position() const { return position_; }
  const Vec3& right() const { return right_; }
  const Vec3& up() const { return up_; }
  const Vec3& forward() const { return forward_; }

  /// A part of the way from one camera to another of the same kind and size: position, size of the view and
  /// lens go straight, the axes along the shorter arc between them. 1 is the other itself, and where they
  /// look opposite ways the nearer of the two.
  static Camera between(const Camera&, const Camera&, float part);

  /// The same view in a picture so many times as wide and high.
  Camera enlarged(int factor) const {
    Camera larger = *this;
    larger.width_ *= factor;
    larger.height_ *= factor;
    return larger;
  }

  /// Ray through the point (px, py) of the picture, in pixels from its top left corner.
  Ray ray(float px, float py) const;
  /// The same through a point of the lens, given in its radii along right and up: all of them meet in the
  /// plane of focus.
  Ray ray(float px, float py, const Vec2& on_lens) const;
  /// How ray() makes them: directions to forward + x right + y up, or origins there, of places x = 2 px /
  /// width
  /// - 1 and y = 1 - 2 py / height.
  struct ViewPlane {
    Vec3 position, right, up, forward;  // right and up to the view's border
    float width, height;                // of the picture [pixels]
    bool orthographic;
  };
  ViewPlane view_plane() const {
    return {position_,    half_width_ * right_,       half_height_ * up_,
            forward_,     static_cast<float>(width_), static_cast<float>(height_),
            orthographic_};
  }
  /// Radius of the thin lens: sensor_height / (4 f_stop tan(fov/2)) [m]; 0 of a pinhole.
  float lens_radius() const { return lens_radius_; }
  float focus_distance() const { return focus_distance_; }
  int blades() const { return blades_; }
  float blade_rotation() const { return blade_rotation_; }
  /// World to eye.
  Mat4 view() const;
  /// Eye to clip, OpenGL conventions (z in [-w, w]).
  Mat4 projection(float near, float far) const;
  /// Depth of a world point: metres along the view axis from the camera's plane.
  float depth(const Vec3& world) const { return (world - position_).dot(forward_); }
  /// The same of a point on a ray of this camera at a distance [m].
  float depth(const Ray& ray, double distance) const {
    return static_cast<float>(distance * ray.direction.cast<double>().dot(forward_.cast<double>()));
  }
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
  float lens_radius_ = 0.0F;     // [m]
  float focus_distance_ = 0.0F;  // [m]
  int blades_;
  float blade_rotation_;  // [degrees]
};

/// The camera at a time from 0, the shutter opens, to 1, it closes, of two or more at equidistant times.
Camera camera_at(std::span<const Camera>, float time);

}  // namespace lagomorph::render
