#include "apps/overlay/arrows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/overlay/shapes.h"

namespace lagomorph::apps {
namespace {

constexpr double hidden_opacity = 0.22, rim_opacity = 0.65;
constexpr double rim = 1.0;           // width around signs [pixels]
constexpr double least_head = 5.0;    // [pixels]
constexpr double head_width = 0.78;   // of a head's length
constexpr double shaft_width = 0.24;  // likewise

double pixels(const render::Camera& camera, double length, double depth) {
  return length / static_cast<double>(camera.pixel_size(static_cast<float>(depth)));
}

/// The corners of a head, grown by so many pixels.
std::array<Point, 3> head_corners(Point tip, Point along, double length, double grown) {
  const double half = 0.5 * head_width * length + 1.3 * grown;
  const Point front{tip.x + 2.2 * grown * along.x, tip.y + 2.2 * grown * along.y};
  const Point back{tip.x - (length + grown) * along.x, tip.y - (length + grown) * along.y};
  return {front, Point{back.x - half * along.y, back.y + half * along.x},
          Point{back.x + half * along.y, back.y - half * along.x}};
}

void draw_arrow(render::Picture& picture, const View& view, const Arrow& arrow, bool hidden_by_things) {
  const render::Camera& camera = view.camera();
  const ViewPoint a = view_point(camera, arrow.from), b = view_point(camera, arrow.to);
  if (a.depth < near_depth || b.depth < near_depth) return;
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (length < 0.5) return;  // nothing to be seen, or towards the eye
  const Point along{(b.x - a.x) / length, (b.y - a.y) / length};
  const double head = std::min(std::max(least_head, pixels(camera, arrow.head, b.depth)), 0.7 * length);
  const double width = std::max(1.2, shaft_width * head);
  const render::Vec3 base = arrow.to + static_cast<float>(0.8 * head / length) * (arrow.from - arrow.to);
  SeenLines shaft;
  view.add_line(arrow.from, base, {}, shaft);
  const bool tip_seen = !hidden_by_things || view.sees(arrow.to) || view.sees(base);
  if (!hidden_by_things) {
    shaft.visible.insert(shaft.visible.end(), shaft.hidden.begin(), shaft.hidden.end());
    shaft.hidden.clear();
  }
  const Point tip{b.x, b.y};
  draw_strokes(picture, shaft.hidden, width, arrow.color, hidden_opacity);
  draw_strokes(picture, shaft.visible, width + 2.0 * rim, rim_color, rim_opacity);
  if (tip_seen) fill_convex(picture, head_corners(tip, along, head, rim), rim_color, rim_opacity);
  draw_strokes(picture, shaft.visible, width, arrow.color);
  fill_convex(picture, head_corners(tip, along, head, 0.0), arrow.color, tip_seen ? 1.0 : hidden_opacity);
}

}  // namespace

void draw_arrows(render::Picture& picture, const View& view, std::vector<Arrow> arrows,
                 bool hidden_by_things) {
  std::stable_sort(arrows.begin(), arrows.end(), [&](const Arrow& a, const Arrow& b) {
    return view.camera().depth(a.to) > view.camera().depth(b.to);
  });
  for (const Arrow& arrow : arrows) draw_arrow(picture, view, arrow, hidden_by_things);
}

void draw_dots(render::Picture& picture, const render::Camera& camera, std::vector<Dot> dots) {
  std::stable_sort(dots.begin(), dots.end(),
                   [&](const Dot& a, const Dot& b) { return camera.depth(a.at) > camera.depth(b.at); });
  for (const Dot& dot : dots) {
    const ViewPoint at = view_point(camera, dot.at);
    if (at.depth < near_depth) continue;
    const double radius = std::max(2.5, 0.5 * pixels(camera, dot.diameter, at.depth));
    const Point center{at.x, at.y};
    if (!dot.visible) {
      fill_disc(picture, center, 0.6 * radius, dot.color, hidden_opacity);
      continue;
    }
    fill_disc(picture, center, radius + rim, rim_color, rim_opacity);
    fill_disc(picture, center, radius, dot.color);
    if (dot.hollow) fill_disc(picture, center, 0.5 * radius, rim_color);
  }
}

}  // namespace lagomorph::apps
