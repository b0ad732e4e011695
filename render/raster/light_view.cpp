#include "render/raster/light_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lagomorph::render::raster {
namespace {

constexpr float widest_tangent = 6.0F;        // some 80 degrees off the light's axis
constexpr float nearest_of_farthest = 1e-3F;  // what is nearer to the light's plane is cut off

struct Interval {
  float low = std::numeric_limits<float>::max();
  float high = std::numeric_limits<float>::lowest();

  void add(float x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  float size() const { return high - low; }
};

/// A little larger, with both ends on a grid that only the order of magnitude decides.
Interval snapped(const Interval& range) {
  const float step = std::exp2(std::ceil(std::log2(std::max(range.size(), 1e-4F))) - 4.0F);
  return {step * std::floor(range.low / step - 0.1F), step * std::ceil(range.high / step + 0.1F)};
}

}  // namespace

LightView fit_light_view(const AreaLight& light, std::span<const std::vector<Vec3>> positions, int map_size) {
  return fit_light_view(light.position, light_frame(light), 0.0F, positions, map_size);
}

LightView fit_light_view(const Vec3& from, const LightFrame& frame, float nearest,
                         std::span<const std::vector<Vec3>> positions, int map_size) {
  float farthest = 0.0F;
  for (const std::vector<Vec3>& mesh : positions) {
    for (const Vec3& p : mesh) farthest = std::max(farthest, (p - from).dot(frame.normal));
  }
  LightView view;
  view.size = map_size;
  if (!(farthest > nearest)) return view;
  const float limit = std::max(farthest * nearest_of_farthest, nearest);
  Interval x, y, z;
  for (const std::vector<Vec3>& mesh : positions) {
    for (const Vec3& p : mesh) {
      const Vec3 d = p - from;
      const float along = std::max(d.dot(frame.normal), limit);
      x.add(std::clamp(d.dot(frame.right) / along, -widest_tangent, widest_tangent));
      y.add(std::clamp(d.dot(frame.up) / along, -widest_tangent, widest_tangent));
      z.add(along);
    }
  }
  x = snapped(x);
  y = snapped(y);
  const float near = 0.98F * z.low;
  const float far = 1.02F * z.high;

  Mat4 eye = Mat4::Identity();  // z grows away from the light
  eye.block<1, 3>(0, 0) = frame.right.transpose();
  eye.block<1, 3>(1, 0) = frame.up.transpose();
  eye.block<1, 3>(2, 0) = frame.normal.transpose();
  eye.block<3, 1>(0, 3) = -(eye.block<3, 3>(0, 0) * from);
  Mat4 clip = Mat4::Zero();
  clip(0, 0) = 2.0F / x.size();
  clip(0, 2) = -(x.low + x.high) / x.size();
  clip(1, 1) = 2.0F / y.size();
  clip(1, 2) = -(y.low + y.high) / y.size();
  clip(2, 2) = (far + near) / (far - near);
  clip(2, 3) = -2.0F * far * near / (far - near);
  clip(3, 2) = 1.0F;
  view.clip_from_world = clip * eye;
  view.map = Vec4(1.0F / x.size(), 1.0F / y.size(), -x.low / x.size(), -y.low / y.size());
  const float texel = std::max(x.size(), y.size()) / static_cast<float>(map_size);
  view.depth = Vec4(1.0F / far - 1.0F / near, 1.0F / near, 1.0F / z.low, texel * far);
  return view;
}

}  // namespace lagomorph::render::raster
