#include "apps/overlay/item_buffer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lagomorph::apps {
namespace {

/// The part of a triangle in front of the camera: up to four corners.
std::size_t clip_near(const render::Camera& camera, const std::array<render::Vec3, 3>& x,
                      std::array<render::Vec3, 4>& kept) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const render::Vec3 &a = x[k], &b = x[(k + 1) % 3];
    const auto da = camera.depth(a) - static_cast<float>(near_depth),
               db = camera.depth(b) - static_cast<float>(near_depth);
    if (da >= 0.0F) kept[count++] = a;
    if ((da >= 0.0F) != (db >= 0.0F)) kept[count++] = a + da / (da - db) * (b - a);
  }
  return count;
}

double cross(const ViewPoint& a, const ViewPoint& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

}  // namespace

ViewPoint view_point(const render::Camera& camera, const render::Vec3& world) {
  const render::Vec2 p = camera.project(world);
  return {static_cast<double>(p.x()), static_cast<double>(p.y()), static_cast<double>(camera.depth(world))};
}

ItemBuffer::ItemBuffer(const render::Camera& camera)
    : camera_(camera), columns_(samples * camera.width()), rows_(samples * camera.height()) {
  const std::size_t count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  depths_.assign(count, std::numeric_limits<float>::infinity());
  items_.assign(count, none);
}

void ItemBuffer::draw(std::span<const render::Triangle> triangles, std::span<const render::Vec3> positions,
                      int first_item) {
  std::array<render::Vec3, 4> corners;
  std::array<ViewPoint, 4> seen;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [i, j, k] = triangles[t];
    const std::array<render::Vec3, 3> x = {positions[i], positions[j], positions[k]};
    const std::size_t count = clip_near(camera_, x, corners);
    for (std::size_t c = 0; c < count; ++c) {
      seen[c] = view_point(camera_, corners[c]);
      seen[c].x *= samples, seen[c].y *= samples;
    }
    for (std::size_t c = 2; c < count; ++c)
      fill(seen[0], seen[c - 1], seen[c], first_item + static_cast<int>(t));
  }
}

void ItemBuffer::peel() {
  peeled_ = depths_;
  std::fill(depths_.begin(), depths_.end(), std::numeric_limits<float>::infinity());
  std::fill(items_.begin(), items_.end(), none);
}

void ItemBuffer::fill(const ViewPoint& a, const ViewPoint& b, const ViewPoint& c, int item) {
  const double area = cross(a, b, c.x, c.y);
  if (!(std::abs(area) > 0.0)) return;
  // Samples are at the middle of their cells.
  const auto cell = [](double place, int most) {
    return static_cast<int>(std::clamp(std::floor(place), -1.0, static_cast<double>(most)));
  };
  const int x0 = std::max(0, cell(std::min({a.x, b.x, c.x}) - 0.5, columns_)),
            x1 = std::min(columns_ - 1, cell(std::max({a.x, b.x, c.x}) + 0.5, columns_)),
            y0 = std::max(0, cell(std::min({a.y, b.y, c.y}) - 0.5, rows_)),
            y1 = std::min(rows_ - 1, cell(std::max({a.y, b.y, c.y}) + 0.5, rows_));
  const bool perspective = !camera_.is_orthographic();
  const auto place = [&](double depth) {
    return perspective ? 1.0 / depth : depth;
  };  // linear in the picture
  const double za = place(a.depth), zb = place(b.depth), zc = place(c.depth);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      const double wa = cross(b, c, px, py) / area, wb = cross(c, a, px, py) / area, wc = 1.0 - wa - wb;
      if (wa < 0.0 || wb < 0.0 || wc < 0.0) continue;
      const double z = wa * za + wb * zb + wc * zc;
      const auto depth = static_cast<float>(perspective ? 1.0 / z : z);
      const std::size_t i = at(x, y);
      if (depth > depths_[i] || (!peeled_.empty() && !(depth > peeled_[i]))) continue;
      depths_[i] = depth;
      items_[i] = item;
    }
  }
}

}  // namespace lagomorph::apps
