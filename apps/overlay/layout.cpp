#include "apps/overlay/layout.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace lagomorph::apps {
namespace {

/// Where something of a size stands that is alone: at one end of a side, in its middle, at the other end.
double anchor(double side, double size, double margin, int end) {
  if (end < 0) return margin;
  return end > 0 ? side - margin - size : 0.5 * (side - size);
}

}  // namespace

OverlayLayout::OverlayLayout(int width, int height)
    : width_(width),
      height_(height),
      unit_(overlay_unit(width, height)),
      text_height_(overlay_text_height(width, height)),
      caption_height_(text_height_) {}

double OverlayLayout::margin() const { return std::round(3.0 * unit_); }

std::optional<Rectangle> OverlayLayout::take(double width, double height, const std::string& place) {
  const std::string_view where = place;
  const double wide = std::ceil(width), tall = std::ceil(height);
  const double margin = this->margin(), gap = std::round(std::max(2.0, 1.5 * unit_));
  const int across = where.ends_with("left") ? -1 : where.ends_with("right") ? 1 : 0;
  const int along = where.starts_with("top") ? -1 : where.starts_with("bottom") ? 1 : 0;
  const double left = std::round(anchor(width_, wide, margin, across)),
               top = std::round(anchor(height_, tall, margin, along));
  // The nearest free room is where it would stand alone, or touches what is in the way in x or in y.
  std::vector<double> lefts = {left}, tops = {top};
  for (const Rectangle& r : taken_) {
    lefts.insert(lefts.end(), {std::ceil(r.right) + gap, std::floor(r.left) - gap - wide});
    tops.insert(tops.end(), {std::ceil(r.bottom) + gap, std::floor(r.top) - gap - tall});
  }
  const auto is_inside = [&](double at, double alone, double size, double side) {
    return at >= std::max(0.0, std::min(margin, alone)) &&
           at + size <= std::min(side, std::max(side - margin, alone + size));
  };
  std::optional<Rectangle> best;
  double least = std::numeric_limits<double>::infinity();
  for (const double x : lefts) {
    for (const double y : tops) {
      const Rectangle r{x, y, x + wide, y + tall};
      const double distance = std::abs(x - left) + std::abs(y - top);
      if (distance >= least || !is_inside(x, left, wide, width_) || !is_inside(y, top, tall, height_))
        continue;
      if (std::any_of(taken_.begin(), taken_.end(), [&](const Rectangle& t) { return overlap(t, r); }))
        continue;
      best = r;
      least = distance;
    }
  }
  if (best) taken_.push_back(*best);
  return best;
}

}  // namespace lagomorph::apps
