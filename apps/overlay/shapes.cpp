#include "apps/overlay/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/overlay/overlay.h"
#include "apps/overlay/stroke_font.h"

namespace lagomorph::apps {
namespace {

/// Blends a colour into the pixels of a box by `distance`, that of a pixel's middle to the shape: negative
/// inside.
template <class Distance>
void fill(render::Picture& picture, const Rectangle& box, const Color& color, double opacity,
          const Distance& distance) {
  const auto pixel = [](double place, int most) {
    return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(most)));
  };
  const int x0 = pixel(box.left - 1.0, picture.width), x1 = pixel(box.right + 2.0, picture.width),
            y0 = pixel(box.top - 1.0, picture.height), y1 = pixel(box.bottom + 2.0, picture.height);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const double c = opacity * std::clamp(0.5 - distance(Point{x + 0.5, y + 0.5}), 0.0, 1.0);
      if (c != 0.0) blend(picture, x, y, color, c);
    }
  }
}

}  // namespace

void fill_disc(render::Picture& picture, Point center, double radius, const Color& color, double opacity) {
  fill(picture, {center.x - radius, center.y - radius, center.x + radius, center.y + radius}, color, opacity,
       [&](Point p) { return std::hypot(p.x - center.x, p.y - center.y) - radius; });
}

void fill_convex(render::Picture& picture, std::span<const Point> corners, const Color& color,
                 double opacity) {
  double area = 0.0;
  constexpr double far = std::numeric_limits<double>::infinity();
  Rectangle box{far, far, -far, -far};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point a = corners[i], b = corners[(i + 1) % corners.size()];
    area += a.x * b.y - b.x * a.y;
    box = {std::min(box.left, a.x), std::min(box.top, a.y), std::max(box.right, a.x),
           std::max(box.bottom, a.y)};
  }
  if (area == 0.0) return;
  const double sense = area > 0.0 ? 1.0 : -1.0;
  fill(picture, box, color, opacity, [&](Point p) {
    double most = -far;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point a = corners[i], b = corners[(i + 1) % corners.size()];
      const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
      if (length == 0.0) continue;
      most = std::max(most, sense * (dy * (p.x - a.x) - dx * (p.y - a.y)) / length);
    }
    return most;
  });
}

void draw_rimmed_text(render::Picture& picture, Point middle, std::string_view text, double height,
                      const Color& color) {
  const double x = middle.x - 0.5 * text_width(text, height), y = middle.y + 0.5 * height;
  constexpr double far = 0.75;  // of a pixel and a quarter: the rim
  for (const Point by : {Point{-far, 0.0}, Point{far, 0.0}, Point{0.0, -far}, Point{0.0, far}})
    draw_text(picture, x + by.x, y + by.y, text, {.height = height, .color = rim_color, .bold = true});
  draw_text(picture, x, y, text, {.height = height, .color = color});
}

}  // namespace lagomorph::apps
