#include "apps/overlay/view.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace lagomorph::apps {
namespace {

/// The part of a line in front of the camera; false when there is none.
bool clip_near(const render::Camera& camera, render::Vec3& a, render::Vec3& b) {
  const float da = camera.depth(a) - static_cast<float>(near_depth),
              db = camera.depth(b) - static_cast<float>(near_depth);
  if (da < 0.0F && db < 0.0F) return false;
  if (da < 0.0F) a += da / (da - db) * (b - a);
  if (db < 0.0F) b += db / (db - da) * (a - b);
  return true;
}

/// Where along a b, in [0, 1], it enters and leaves the picture and a margin around it.
/// [Liang and Barsky 1984]
struct Span {
  double from = 0, to = 1;
};
std::optional<Span> inside(const ViewPoint& a, const ViewPoint& b, double width, double height) {
  constexpr double margin = 16;  // of wide lines [pixels]
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double p[4] = {-dx, dx, -dy, dy};
  const double q[4] = {a.x + margin, width + margin - a.x, a.y + margin, height + margin - a.y};
  Span span;
  for (int i = 0; i < 4; ++i) {
    if (p[i] == 0) {
      if (q[i] < 0) return std::nullopt;
    } else if (p[i] < 0) {
      span.from = std::max(span.from, q[i] / p[i]);
    } else {
      span.to = std::min(span.to, q[i] / p[i]);
    }
  }
  if (span.from >= span.to) return std::nullopt;
  return span;
}

Point between(const ViewPoint& a, const ViewPoint& b, double along) {
  return {a.x + along * (b.x - a.x), a.y + along * (b.y - a.y)};
}

}  // namespace

View::View(const render::Camera& camera, const render::Ground& ground)
    : camera_(camera), ground_(ground), items_(camera) {}

/// The opaque part of the ground, up to where it has faded by half.
bool View::ground_hides(const ViewPoint& p) const {
  if (!ground_.enabled) return false;
  const render::Ray ray = camera_.ray(static_cast<float>(p.x), static_cast<float>(p.y));
  const float slope = ray.direction.y();
  if (slope == 0.0F) return false;
  const float t = (ground_.height - ray.origin.y()) / slope;
  if (!(t > 0.0F)) return false;
  const double depth = static_cast<double>(t * ray.direction.dot(camera_.forward()));
  constexpr double slack = 1e-4;
  if (depth >= p.depth * (1.0 - slack)) return false;
  return render::ground_fade(ground_, ray.origin + t * ray.direction) < 0.5F;
}

bool View::sees(const ViewPoint& p, const IsOwn& is_own) const {
  if (p.depth < near_depth) return false;
  if (ground_hides(p)) return false;
  const int column = static_cast<int>(std::floor(ItemBuffer::samples * p.x)),
            row = static_cast<int>(std::floor(ItemBuffer::samples * p.y));
  if (!items_.holds(column, row)) return true;
  // A surface at 60 degrees to the picture, half a sample away.
  const double slack =
      std::max(1.5 * static_cast<double>(camera_.pixel_size(static_cast<float>(p.depth))), 1e-5 * p.depth);
  if (p.depth <= items_.depth(column, row) + slack) return true;
  if (!is_own) return false;
  for (int y = row - 1; y <= row + 1; ++y) {
    for (int x = column - 1; x <= column + 1; ++x) {
      if (!items_.holds(x, y)) continue;
      const int item = items_.item(x, y);
      if (item != ItemBuffer::none && is_own(item)) return true;
    }
  }
  return false;
}

bool View::sees(const render::Vec3& world, const IsOwn& is_own) const {
  return sees(view_point(camera_, world), is_own);
}

void View::add_line(const render::Vec3& from, const render::Vec3& to, const IsOwn& is_own,
                    SeenLines& lines) const {
  render::Vec3 near_a = from, near_b = to;
  if (!clip_near(camera_, near_a, near_b)) return;
  const ViewPoint a = view_point(camera_, near_a), b = view_point(camera_, near_b);
  const std::optional<Span> span = inside(a, b, camera_.width(), camera_.height());
  if (!span) return;
  const double length = (span->to - span->from) * std::hypot(b.x - a.x, b.y - a.y);
  const int steps = std::max(1, static_cast<int>(std::ceil(ItemBuffer::samples * length)));
  const auto along = [&](double step) { return span->from + (span->to - span->from) * step / steps; };
  int begin = 0;
  bool visible = false;
  const auto end_run = [&](int end) {
    if (end > begin)
      (visible ? lines.visible : lines.hidden)
          .push_back({between(a, b, along(begin)), between(a, b, along(end))});
    begin = end;
  };
  for (int i = 0; i < steps; ++i) {
    const double u = along(i + 0.5);
    const Point p = between(a, b, u);
    // Of a perspective camera the depth's inverse is linear in the picture.
    const double depth = camera_.is_orthographic() ? a.depth + u * (b.depth - a.depth)
                                                   : 1.0 / ((1.0 - u) / a.depth + u / b.depth);
    const bool seen = sees(ViewPoint{p.x, p.y, depth}, is_own);
    if (i > 0 && seen != visible) end_run(i);
    visible = seen;
  }
  end_run(steps);
}

}  // namespace lagomorph::apps
