#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "apps/scene/camera_moves.h"
#include "apps/scene/scene_desc.h"
#include "render/camera.h"
#include "sim/model.h"
#include "sim/surface.h"

namespace lagomorph::apps {

/// The camera of a scene's frames: its moves, and what of them depends on where the bodies are.
class CameraRig {
public:
  /// Model and surfaces are referred to. `width` and `height` are the picture's. [pixels]
  CameraRig(const SceneDesc&, const sim::Model&, const std::vector<sim::Surface>&, int width, int height);

  /// Whether the bodies' box of all frames is to be found by see().
  bool needs_all_states() const { return needs_all_states_; }
  /// Widens the box by the surfaces at positions q.
  void see(const sim::VecX& q);
  /// Least and greatest corner of the box that the camera is fitted to, in the frame that it follows. [m]
  std::optional<std::array<double, 6>> fitted_box() const;

  /// Whether the bodies' box is fitted into the picture.
  bool is_fitted() const { return fits_; }

  /// The camera of a frame, or of a time between frames, when bodies are at q. What is fitted leaves a strip
  /// free at the right, this part of the picture's width.
  render::CameraSettings settings(double frame, const sim::VecX& q, double strip = 0.0) const;
  render::Camera at(double frame, const sim::VecX& q, double strip = 0.0) const;

private:
  sim::Vec3 offset(const sim::VecX& q) const;

  const sim::Model& model_;
  const std::vector<sim::Surface>& surfaces_;
  CameraMoves moves_;
  int width_, height_;
  bool follows_, needs_all_states_, fits_;
  sim::Vec3 center_of_mass_;  // in frame 0 [m]
  std::optional<Eigen::AlignedBox3d> box_;
};

}  // namespace lagomorph::apps
