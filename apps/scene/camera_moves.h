#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "apps/scene/scene_desc.h"
#include "sim/motion_curve.h"

namespace lagomorph::apps {

std::vector<std::string> camera_views();   // none, front, back, left, right, top, bottom, isometric
std::vector<std::string> camera_frames();  // none, center, rest, motion

/// The camera of each frame and of the time between frames, by its keys, view, framing, turntable and zoom.
/// Lengths in metres.
class CameraMoves {
public:
  /// `aspect` is the picture's width over its height.
  CameraMoves(const CameraDesc&, const sim::TimeSettings&, double aspect);

  /// `box` is what camera.frame aims at; none where nothing is known of it yet. It is fitted into what a
  /// strip at the right leaves, which is this part of the picture's width, at most half.
  render::CameraSettings at(double frame, const std::optional<Eigen::AlignedBox3d>& box,
                            double strip = 0.0) const;

private:
  /// A quantity over time, where some key gives it.
  struct Track {
    std::optional<sim::MotionCurve> curve;
    std::optional<sim::VecX> at(double t) const;
  };
  Track track_of(int size, const auto& value) const;
  double fit(render::CameraSettings&, const Eigen::AlignedBox3d&, double strip) const;
  double turn_at(double frame) const;

  CameraDesc camera_;
  double fps_;
  int frames_;
  double aspect_;
  Track position_, look_at_, up_, fov_, orthographic_, zoom_, focus_distance_, f_stop_;
};

/// Moves a camera by an offset.
void shift(render::CameraSettings&, const sim::Vec3& offset);

/// Whether the pictures of a scene are others when it has more frames.
bool depends_on_frame_count(const SceneDesc&);

}  // namespace lagomorph::apps
