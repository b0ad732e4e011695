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
  const LightFrame frame = light_frame(light);
  float farthest = 0.0F;
  for (const std::vector<Vec3>& mesh : positions) {
    for (const Vec3& p : mesh) farthest = std::max(farthest, (p - light.position).dot(frame.normal));
  }
  LightView view;
  if (!(farthest > 0.0F)) return view;
  const float limit = farthest * nearest_of_farthest;
  Interval x, y, z;
  for (const std::vector<Vec3>& mesh : positions) {
    for (const Vec3& p : mesh) {
      const Vec3 d = p - light.position;
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
  eye.block<3, 1>(0, 3) = -(eye.block<3, 3>(0, 0) * light.position);
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

Vec4 shadowed_ground(const RenderScene& scene, const Eigen::AlignedBox3f& box) {
  const Ground& g = scene.ground;
  const float left = g.center.x() - g.radius;
  const float right = g.center.x() + g.radius;
  const float back = g.center.z() - g.radius;
  const float front = g.center.z() + g.radius;
  Interval x, z;
  for (const AreaLight& light : scene.lights) {
    if (box.isEmpty() || box.max().y() <= g.height) break;
    const LightFrame frame = light_frame(light);
    for (int i = 0; i < 4; ++i) {
      const Vec3 from = light.position + ((i & 1) - 0.5F) * light.size.x() * frame.right +
                        ((i >> 1) - 0.5F) * light.size.y() * frame.up;
      if (from.y() <= box.max().y()) return {left, back, right, front};  // shadows without end
      for (int k = 0; k < 8; ++k) {
        Vec3 p = box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(k));
        p.y() = std::max(p.y(), g.height);
        const Vec3 on_ground = p + (from - p) * ((g.height - p.y()) / (from.y() - p.y()));
        x.add(on_ground.x());
        z.add(on_ground.z());
      }
    }
  }
  if (x.low > x.high) x = z = Interval{0.0F, 0.0F};  // no light, no mesh
  return {std::clamp(x.low, left, right), std::clamp(z.low, back, front), std::clamp(x.high, left, right),
          std::clamp(z.high, back, front)};
}

}  // namespace lagomorph::render::raster
