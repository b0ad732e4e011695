#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/backends.h"
#include "tests/unit/render/path/shapes.h"

/// A white square over a floor, seen from above, for what moves while the shutter is open.
namespace lagomorph::render::floating_square {

constexpr int width = 80, height = 8;
constexpr float span = 4.0F;  // width of the view [m]

inline RenderSettings settings() {
  RenderSettings s;
  s.backend = "path";
  s.width = width;
  s.height = height;
  s.samples = 1024;
  s.path.bounces = 0;
  s.path.filter = "box";
  s.path.filter_radius = 0.5F;
  return s;
}

/// A white square of side 1 that floats at y = 1 over a floor, seen from above; moving along x.
inline RenderScene floating(bool with_floor) {
  RenderScene scene;
  scene.ground.enabled = with_floor;
  scene.ground.radius = 100.0F;
  scene.ground.fade_start = 90.0F;
  scene.ground.material = {Color::Constant(0.5F), 1.0F, 0.0F, 1.0F};
  scene.sky.zenith = scene.sky.horizon = Color::Ones();
  scene.sky.strength = with_floor ? 0.0F : 1.0F;
  scene.background = Color::Zero();
  scene.meshes = {make_quad(Vec3(-0.5F, 1, 0.5F), Vec3(1, 0, 0), Vec3(0, 0, -1))};
  scene.meshes[0].material = {Color::Ones(), 1.0F, 0.0F, 1.0F};
  scene.motion_segments = 1;
  return scene;
}

inline CameraSettings above() {
  CameraSettings c;
  c.position = Vec3(0, 5, 0);
  c.look_at = Vec3::Zero();
  c.up = Vec3(0, 0, -1);
  c.orthographic = span * height / width;
  return c;
}

inline std::vector<Vec3> shifted(const RenderScene& scene, float x) {
  std::vector<Vec3> positions = scene.meshes[0].positions;
  for (Vec3& p : positions) p.x() += x;
  return positions;
}

/// Mean of a column's red, at the x of its middle.
inline std::vector<double> columns(const Image& image) {
  const std::vector<float>& values = image.find("color")->values;
  std::vector<double> sums(width, 0.0);
  for (std::size_t i = 0; i < values.size(); i += 3) sums[i / 3 % width] += values[i] / height;
  return sums;
}

/// Part of the time that a square of side 1, its middle going from 0 to `to`, is over x.
inline double covered(double x, double to) {
  const double from_time = (x - 0.5) / to;
  const double to_time = (x + 0.5) / to;
  return std::max(
      std::clamp(std::max(from_time, to_time), 0.0, 1.0) - std::clamp(std::min(from_time, to_time), 0.0, 1.0),
      0.0);
}

using Steps = std::vector<std::vector<Vec3>>;

/// The square's places at the time steps before the last, its middle at x(t).
template <class Way>
Steps steps_of(const RenderScene& scene, const Way& x) {
  Steps steps;
  for (int step = 0; step < scene.motion_segments; ++step)
    steps.push_back(shifted(scene, x(static_cast<float>(step) / static_cast<float>(scene.motion_segments))));
  return steps;
}

/// The middle of a column, in the plane of the square. [m]
inline double middle_of(int column) {
  return (column + 0.5) * static_cast<double>(span) / width - static_cast<double>(span) / 2.0;
}

}  // namespace lagomorph::render::floating_square
