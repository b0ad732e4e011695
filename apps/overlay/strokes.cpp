#include "apps/overlay/strokes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/overlay/overlay.h"

namespace lagomorph::apps {
namespace {

/// Distance of a point to the segment a b.
double distance(Point p, Point a, Point b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double length2 = dx * dx + dy * dy;
  const double along =
      length2 > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - along * dx, p.y - a.y - along * dy);
}

/// Pixels x0..x1, y0..y1; none when x0 > x1 or y0 > y1.
struct Box {
  int x0 = 0, y0 = 0, x1 = -1, y1 = -1;
  int width() const { return std::max(0, x1 - x0 + 1); }
  int height() const { return std::max(0, y1 - y0 + 1); }
};

int pixel(double place, int most) { return static_cast<int>(std::clamp(place, -1.0, most + 1.0)); }

/// The pixels that a stroke of this radius may touch.
Box box_of(std::span<const Segment> segments, double radius, const render::Picture& picture) {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  for (const Segment& s : segments) {
    left = std::min({left, s.a.x, s.b.x}), right = std::max({right, s.a.x, s.b.x});
    top = std::min({top, s.a.y, s.b.y}), bottom = std::max({bottom, s.a.y, s.b.y});
  }
  return {std::max(0, pixel(left - radius - 1, picture.width)),
          std::max(0, pixel(top - radius - 1, picture.height)),
          std::min(picture.width - 1, pixel(right + radius + 1, picture.width)),
          std::min(picture.height - 1, pixel(bottom + radius + 1, picture.height))};
}

}  // namespace

void draw_strokes(render::Picture& picture, std::span<const Segment> segments, double width,
                  const Color& color, double opacity) {
  const double radius = std::max(0.5, 0.5 * width);
  const Box all = box_of(segments, radius, picture);
  const auto place = [&](int x, int y) {
    return static_cast<std::size_t>(y - all.y0) * static_cast<std::size_t>(all.width()) +
           static_cast<std::size_t>(x - all.x0);
  };
  std::vector<double> cover(static_cast<std::size_t>(all.width()) * static_cast<std::size_t>(all.height()));
  for (const Segment& s : segments) {
    const Box box = box_of({&s, 1}, radius, picture);
    for (int y = box.y0; y <= box.y1; ++y) {
      for (int x = box.x0; x <= box.x1; ++x) {
        double& c = cover[place(x, y)];
        c = std::max(c, std::clamp(radius + 0.5 - distance({x + 0.5, y + 0.5}, s.a, s.b), 0.0, 1.0));
      }
    }
  }
  for (int y = all.y0; y <= all.y1; ++y) {
    for (int x = all.x0; x <= all.x1; ++x) {
      const double c = opacity * cover[place(x, y)];
      if (c != 0) blend(picture, x, y, color, c);
    }
  }
}

}  // namespace lagomorph::apps
