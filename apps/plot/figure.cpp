#include "apps/plot/figure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "apps/overlay/stroke_font.h"
#include "apps/overlay/ticks.h"

namespace lagomorph::apps {
namespace {

/// Okabe and Ito's colours without the yellow, which is too light for lines. ["Color Universal Design", 2008]
constexpr std::array<Color, 7> colors = {
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}, {0, 0, 0}}};
constexpr Color ink = {40, 40, 40}, faint = {222, 222, 222}, grey = {110, 110, 110};

/// Sizes in pixels for a figure of 1200x800; others in proportion.
constexpr double title_height = 17, label_height = 13, line_width = 2.6, dot_width = 8, gap = 10;

struct Box {
  double left = 0, top = 0, right = 0, bottom = 0;
};

/// From values to [0, 1].
struct Scale {
  bool log = false;
  double low = 0, high = 1;  // of log, their decadic logarithms
  std::vector<double> ticks;

  bool holds(double value) const { return std::isfinite(value) && (!log || value > 0); }
  double at(double value) const { return ((log ? std::log10(value) : value) - low) / (high - low); }
};

/// The smallest and the largest value that an axis can show.
struct Extent {
  double low = 1, high = -1;
  bool empty() const { return low > high; }
  void add(double value) {
    const bool first = empty();
    low = first ? value : std::min(low, value);
    high = first ? value : std::max(high, value);
  }
};

Extent extent_of(const Figure& figure, bool of_x) {
  Extent extent;
  const bool log_x = figure.x.log, log_y = figure.y.log;
  for (const Curve& curve : figure.curves) {
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      const double x = curve.x[i], y = curve.y[i];
      if (!std::isfinite(x) || !std::isfinite(y) || (log_x && x <= 0) || (log_y && y <= 0)) continue;
      extent.add(of_x ? x : y);
    }
  }
  return extent;
}

/// A whole range around one value: 0.. for what may be seen as a size, a tenth around anything else.
void widen(Extent& extent) {
  if (extent.empty()) extent.low = 0, extent.high = 1;
  const double size = std::max(std::abs(extent.low), std::abs(extent.high));
  if (extent.high - extent.low > 1e-9 * size) return;
  if (size == 0) {
    extent.high = 1;
  } else {
    extent.low -= 0.1 * size, extent.high += 0.1 * size;
  }
}

Scale scale_of(const Axis& axis, Extent extent, bool ends_at_ticks) {
  Scale scale;
  scale.log = axis.log;
  if (axis.log) {
    if (extent.empty()) extent.low = 0.1, extent.high = 1;
    if (axis.low) extent.low = *axis.low;
    if (axis.high) extent.high = *axis.high;
    scale.ticks = decade_ticks(extent.low, std::max(extent.low, extent.high));
    scale.low = std::log10(scale.ticks.front()), scale.high = std::log10(scale.ticks.back());
    return scale;
  }
  if (axis.low) extent.low = *axis.low;
  if (axis.high) extent.high = *axis.high;
  widen(extent);
  scale.ticks = ticks(extent.low, extent.high, ends_at_ticks ? 6 : 8);
  if (axis.whole) std::erase_if(scale.ticks, [](double t) { return std::abs(t - std::round(t)) > 1e-9; });
  scale.low = ends_at_ticks && !axis.low ? std::min(scale.ticks.front(), extent.low) : extent.low;
  scale.high = ends_at_ticks && !axis.high ? std::max(scale.ticks.back(), extent.high) : extent.high;
  const double slack = 1e-9 * (scale.high - scale.low);
  std::erase_if(scale.ticks, [&](double t) { return t < scale.low - slack || t > scale.high + slack; });
  return scale;
}

/// A tick's number with no more digits than tell it from its neighbours.
std::string number(double value, const Scale& scale) {
  if (scale.log) return fmt::format("{:g}", value);
  const double size = std::max(std::abs(scale.low), std::abs(scale.high));
  if (std::abs(value) < 1e-9 * size) return "0";
  return fmt::format("{:.6g}", value);
}

std::string with_unit(const Axis& axis) {
  return axis.unit.empty() ? axis.label : fmt::format("{} [{}]", axis.label, axis.unit);
}

/// The part of a segment inside of the box (Liang and Barsky 1984); false when there is none.
bool clip(Segment& s, const Box& box) {
  const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y;
  const double p[4] = {-dx, dx, -dy, dy};
  const double q[4] = {s.a.x - box.left, box.right - s.a.x, s.a.y - box.top, box.bottom - s.a.y};
  double from = 0, to = 1;
  for (int i = 0; i < 4; ++i) {
    if (p[i] == 0) {
      if (q[i] < -1e-9) return false;
    } else if (p[i] < 0) {
      from = std::max(from, q[i] / p[i]);
    } else {
      to = std::min(to, q[i] / p[i]);
    }
  }
  if (from > to) return false;
  const Point a = s.a;
  if (to < 1) s.b = {a.x + to * dx, a.y + to * dy};
  if (from > 0) s.a = {a.x + from * dx, a.y + from * dy};
  return true;
}

/// Where a curve's name stands.
struct Label {
  Point end;  // of the curve
  double y = 0;
  std::size_t curve = 0;
};

/// Moves labels apart to `apart` pixels, none outside of low..high where they fit, in the order of their
/// ends.
void spread(std::vector<Label>& labels, double apart, double low, double high) {
  std::stable_sort(labels.begin(), labels.end(),
                   [](const Label& a, const Label& b) { return a.end.y < b.end.y; });
  double least = low;
  for (Label& label : labels) {
    label.y = std::max(label.end.y, least);
    least = label.y + apart;
  }
  double most = high;
  for (auto label = labels.rbegin(); label != labels.rend(); ++label) {
    label->y = std::min(label->y, most);
    most = label->y - apart;
  }
}

class Layout {
public:
  Layout(const Figure& figure, const Box& outside, double unit, Drawing& drawing)
      : figure_(figure), outside_(outside), unit_(unit), drawing_(drawing) {
    x_ = scale_of(figure.x, extent_of(figure, true), false);
    y_ = scale_of(figure.y, extent_of(figure, false), true);
    place();
  }

  void draw() {
    draw_grid();
    for (std::size_t i = 0; i < figure_.curves.size(); ++i) draw_curve(i);
    if (figure_.curves.size() > 1) draw_names();
  }

private:
  double letters() const { return unit_ * label_height; }

  /// Room for the title and the axis' name above, numbers at the left and below, names at the right.
  void place() {
    const double margin = 2 * gap * unit_;
    double numbers = 0, names = 0;
    for (const double tick : y_.ticks) numbers = std::max(numbers, text_width(number(tick, y_), letters()));
    if (figure_.curves.size() > 1) {
      for (const Curve& curve : figure_.curves) names = std::max(names, text_width(curve.name, letters()));
      names += 3 * gap * unit_;
    }
    names = std::min(names, 0.4 * (outside_.right - outside_.left));
    area_ = {outside_.left + margin + numbers + gap * unit_,
             outside_.top + margin + unit_ * (title_height + 4 * gap) + letters(),
             outside_.right - margin - std::max(names, 2 * gap * unit_),
             outside_.bottom - margin - 2 * letters() - 2.2 * gap * unit_};
  }

  Point at(double x, double y) const {
    return {area_.left + x_.at(x) * (area_.right - area_.left),
            area_.bottom - y_.at(y) * (area_.bottom - area_.top)};
  }
  double x_at(double x) const { return area_.left + x_.at(x) * (area_.right - area_.left); }
  double y_at(double y) const { return area_.bottom - y_.at(y) * (area_.bottom - area_.top); }

  void add_line(Point a, Point b, double width, const Color& color) {
    drawing_.shapes.emplace_back(Stroke{{{a, b}}, std::max(1.0, unit_ * width), color});
  }
  void add_words(Point at, std::string text, Anchor anchor, const Color& color) {
    drawing_.shapes.emplace_back(Words{at, std::move(text), letters(), color, anchor, false});
  }

  void draw_grid() {
    const double margin = 2 * gap * unit_;
    drawing_.shapes.emplace_back(Words{{outside_.left + margin, outside_.top + margin + unit_ * title_height},
                                       figure_.title,
                                       unit_ * title_height,
                                       ink,
                                       Anchor::start,
                                       true});
    add_words({outside_.left + margin, area_.top - 2 * gap * unit_}, with_unit(figure_.y), Anchor::start,
              grey);
    for (const double tick : y_.ticks) {
      const double y = y_at(tick);
      add_line({area_.left, y}, {area_.right, y}, 1, !y_.log && tick == 0 ? grey : faint);
      add_words({area_.left - gap * unit_, y + 0.5 * letters()}, number(tick, y_), Anchor::end, ink);
    }
    add_line({area_.left, area_.bottom}, {area_.right, area_.bottom}, 1.4, grey);
    for (const double tick : x_.ticks) {
      const double x = x_at(tick);
      add_line({x, area_.bottom}, {x, area_.bottom + 0.6 * gap * unit_}, 1.4, grey);
      add_words({x, area_.bottom + 1.2 * gap * unit_ + letters()}, number(tick, x_), Anchor::middle, ink);
    }
    add_words({0.5 * (area_.left + area_.right), area_.bottom + 2.2 * gap * unit_ + 2 * letters()},
              with_unit(figure_.x), Anchor::middle, grey);
  }

  bool shows(const Curve& curve, std::size_t i) const { return x_.holds(curve.x[i]) && y_.holds(curve.y[i]); }

  void draw_curve(std::size_t index) {
    const Curve& curve = figure_.curves[index];
    std::vector<Segment> segments;
    const auto add = [&](Segment s) {
      if (clip(s, area_)) segments.push_back(s);
    };
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (!shows(curve, i)) continue;
      const Point p = at(curve.x[i], curve.y[i]);
      const bool begins = i == 0 || !shows(curve, i - 1);
      const bool alone = begins && (i + 1 == curve.x.size() || !shows(curve, i + 1));
      if (curve.dots || alone) {
        add({p, p});
      } else if (!begins) {
        add({at(curve.x[i - 1], curve.y[i - 1]), p});
      }
    }
    const std::size_t round = index / colors.size();  // of the colours
    const bool dashes = round % 2 == 1 && !curve.dots;
    if (dashes) segments = dashed(segments, 9 * unit_, 7 * unit_);
    drawing_.shapes.emplace_back(Stroke{std::move(segments),
                                        std::max(1.2, unit_ * (curve.dots ? dot_width : line_width)),
                                        colors[index % colors.size()]});
  }

  void draw_names() {
    std::vector<Label> labels;
    for (std::size_t c = 0; c < figure_.curves.size(); ++c) {
      const Curve& curve = figure_.curves[c];
      for (std::size_t i = curve.x.size(); i-- > 0;) {
        if (!shows(curve, i)) continue;
        Point end = at(curve.x[i], curve.y[i]);
        end.x = std::clamp(end.x, area_.left, area_.right),
        end.y = std::clamp(end.y, area_.top, area_.bottom);
        labels.push_back({.end = end, .y = end.y, .curve = c});
        break;
      }
    }
    spread(labels, 1.7 * letters(), area_.top, area_.bottom);
    const double left = area_.right + 2.6 * gap * unit_;
    for (const Label& label : labels) {
      const Color& color = colors[label.curve % colors.size()];
      add_line({label.end.x + 0.5 * gap * unit_, label.end.y}, {left - 0.6 * gap * unit_, label.y}, 1, color);
      add_words({left, label.y + 0.5 * letters()},
                fitting_text(figure_.curves[label.curve].name, letters(), outside_.right - left),
                Anchor::start, color);
    }
  }

  const Figure& figure_;
  Box outside_;
  double unit_;
  Drawing& drawing_;
  Scale x_, y_;
  Box area_;
};

}  // namespace

Drawing draw_figure(const Figure& figure, int width, int height) {
  Drawing drawing{.width = width, .height = height, .shapes = {}};
  const double unit = std::min(width / 1200.0, height / 800.0);
  Layout(figure, {0, 0, static_cast<double>(width), static_cast<double>(height)}, unit, drawing).draw();
  return drawing;
}

Drawing draw_overview(const std::vector<Figure>& figures, int width) {
  const std::size_t columns = figures.size() > 1 ? 2 : 1, rows = (figures.size() + columns - 1) / columns;
  const double cell = static_cast<double>(width) / static_cast<double>(columns), height = 0.55 * cell;
  Drawing drawing{
      .width = width, .height = static_cast<int>(height * static_cast<double>(rows)), .shapes = {}};
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const std::size_t row = i / columns, column = i % columns;
    const double left = cell * static_cast<double>(column), top = height * static_cast<double>(row);
    Layout(figures[i], {left, top, left + cell, top + height}, height / 620, drawing).draw();
  }
  return drawing;
}

}  // namespace lagomorph::apps
