#include "apps/overlay/color_bar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "apps/overlay/overlay.h"
#include "apps/overlay/shapes.h"
#include "apps/overlay/stroke_font.h"
#include "apps/overlay/swatches.h"
#include "apps/overlay/ticks.h"

namespace lagomorph::apps {
namespace {

struct Prefix {
  const char* name;
  double factor;
};

/// That of a value's thousands; none beyond them, for pure numbers, and of units that have one.
Prefix prefix_of(double size, const std::string& unit) {
  constexpr std::array<Prefix, 8> prefixes = {
      {{"T", 1e12}, {"G", 1e9}, {"M", 1e6}, {"k", 1e3}, {"", 1.0}, {"m", 1e-3}, {"u", 1e-6}, {"n", 1e-9}}};
  if (unit.empty() || unit.starts_with("k") || size >= 1e15) return {"", 1.0};
  for (const Prefix& prefix : prefixes)
    if (size >= prefix.factor) return prefix;
  return {"", 1.0};
}

/// With the digits that a step of this size needs.
std::string number_text(double value, double step, double size) {
  if (std::abs(value) < 0.5 * step) return "0";
  if (size >= 1e5 || size < 1e-3) return fmt::format("{:.4g}", value);
  return fmt::format("{:.{}f}", value, std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9))));
}

std::string end_text(double value) { return fmt::format("{:.4g}", value + 0.0); }  // no -0

constexpr double line_pitch = 1.7;      // of a title's lines, over their height
constexpr double label_pitch = 1.3;     // of labels at the least, likewise
constexpr double widest = 0.37;         // plate, of the picture's width, but for what labels need
constexpr double widest_labels = 0.42;  // likewise; without a bar beyond
constexpr int most_steps = 8;

/// A bar on its plate.
struct BarLayout {
  double unit, text, pad, bar_height;
  BarLabels labels;
  std::vector<std::string> title;  // a line each
  double title_width, labels_width;
  bool given;

  double tick() const { return 0.9 * unit; }
  double bar_width() const { return 3.0 * unit; }
  double tip() const { return std::max(4.0, std::round(2.4 * unit)); }  // of a pointed end
  /// More than half a label, which has room at every end.
  double ends() const { return given ? std::max(0.0, tip() - 0.5 * text) : 0.0; }
  double gap() const { return std::max(2.2 * tick(), 4.0); }  // from the bar to its labels
  double column() const { return bar_width() + gap() + labels_width; }
  double width() const { return 2.0 * pad + std::max(title_width, column()); }
  double title_height() const { return text * (1.0 + line_pitch * static_cast<double>(title.size() - 1)); }
  double above_bar() const { return pad + title_height() + std::max(1.5 * pad, 1.3 * text) + ends(); }
  double height() const { return above_bar() + bar_height + ends() + 0.5 * text + pad; }
};

double widest_of(const std::vector<std::string>& lines, double height) {
  double width = 0.0;
  for (const std::string& line : lines) width = std::max(width, text_width(line, height));
  return width;
}

/// A title that is wider than `width` in two lines, broken at the blank that makes them as narrow as can be.
std::vector<std::string> title_lines(const std::string& title, double height, double width) {
  double least = text_width(title, height);
  std::vector<std::string> lines = {title};
  if (least <= width) return lines;
  for (std::size_t at = title.find(' '); at != std::string::npos; at = title.find(' ', at + 1)) {
    std::vector<std::string> two = {title.substr(0, at), title.substr(at + 1)};
    const double wide = widest_of(two, height);
    if (wide >= least) continue;
    least = wide;
    lines = std::move(two);
  }
  return lines;
}

/// A title in lines of `width`, words that are wider cut.
std::vector<std::string> wrapped(const std::string& title, double height, double width) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < title.size();) {
    const std::size_t end = std::min(title.find(' ', at), title.size());
    const std::string word = fitting_text(title.substr(at, end - at), height, width);
    if (!lines.empty() && text_width(lines.back() + " " + word, height) <= width) {
      lines.back() += " " + word;
    } else {
      lines.push_back(word);
    }
    at = end + 1;
  }
  return lines;
}

/// All that may ever stand beside a bar has room, so that its plate is the same in all frames.
void set_labels(BarLayout& l, const ColorBar& bar) {
  const double apart = label_pitch * l.text / l.bar_height;
  const int steps = std::clamp(static_cast<int>(1.0 / apart), 1, most_steps);
  l.labels = labels_of(bar, steps, apart);
  l.labels_width = 0.0;
  for (const bool beyond : {false, true}) {
    if (beyond && !bar.given) continue;
    ColorBar as = bar;
    as.below = as.above = beyond;
    for (const BarLabel& label : labels_of(as, steps, apart).ticks)
      l.labels_width = std::max(l.labels_width, text_width(label.text, l.text));
  }
}

/// Where it would take more than its part of the width, pads are smaller and the title has more lines; where
/// it would be too tall then, the bar is shorter.
BarLayout layout_of(int width, int height, const ColorBar& bar) {
  BarLayout l{};
  l.unit = overlay_unit(width, height);
  l.text = overlay_text_height(width, height);
  l.pad = 1.2 * l.text;
  l.bar_height = 42.0 * l.unit;
  l.given = bar.given;
  set_labels(l, bar);
  l.title = title_lines(l.labels.title, l.text, l.column());
  l.title_width = widest_of(l.title, l.text);
  if (l.width() > widest * width) {
    l.pad = 0.6 * l.text;
    const double room = std::max(l.column(), widest * width - 2.0 * l.pad);
    if (l.title_width > room) l.title = wrapped(l.labels.title, l.text, room);
    l.title_width = widest_of(l.title, l.text);
  }
  const double over = l.height() - (height - 6.0 * l.unit);
  if (over > 0.0) {
    l.bar_height = std::max(20.0 * l.unit, l.bar_height - std::ceil(over) - 1.0);
    set_labels(l, bar);
  }
  return l;
}

Color color_at(const render::Colormap& map, double value) {
  const std::array<float, 3> rgb = render::srgb_of(map, static_cast<float>(value));
  Color color;
  for (std::size_t i = 0; i < 3; ++i) color[i] = static_cast<std::uint8_t>(std::lround(255.0F * rgb[i]));
  return color;
}

void draw_gradient(render::Picture& picture, const Rectangle& bar, const render::Colormap& map) {
  double y = bar.top;
  while (y < bar.bottom) {
    const double end = std::min(std::floor(y) + 1.0, bar.bottom);
    const double value = (bar.bottom - 0.5 * (y + end)) / (bar.bottom - bar.top);
    fill_rectangle(picture, {bar.left, y, bar.right, end}, color_at(map, value));
    y = end;
  }
}

/// A bar's outline, with points at the ends beyond which values lie.
std::vector<Point> outline(const Rectangle& r, double above, double below) {
  const double middle = 0.5 * (r.left + r.right);
  std::vector<Point> corners = {{r.left, r.bottom}, {r.left, r.top}};
  if (above > 0.0) corners.push_back({middle, r.top - above});
  corners.insert(corners.end(), {{r.right, r.top}, {r.right, r.bottom}});
  if (below > 0.0) corners.push_back({middle, r.bottom + below});
  return corners;
}

void draw_tip(render::Picture& picture, const Rectangle& colors, double base, double tip,
              const Color& color) {
  const std::array<Point, 3> corners = {
      {{colors.left, base}, {0.5 * (colors.left + colors.right), tip}, {colors.right, base}}};
  fill_convex(picture, corners, color);
}

void draw_colors(render::Picture& picture, const ColorBar& bar, const Rectangle& colors, double line,
                 double tip) {
  const Rectangle around{colors.left - line, colors.top - line, colors.right + line, colors.bottom + line};
  if (bar.below || bar.above) {
    fill_convex(picture, outline(around, bar.above ? tip : 0.0, bar.below ? tip : 0.0), plate_ink, 0.5);
  } else {
    fill_rectangle(picture, around, plate_ink, 0.5);
  }
  draw_gradient(picture, colors, *bar.map);
  if (bar.above) draw_tip(picture, colors, colors.top, colors.top - tip, color_at(*bar.map, 1.0));
  if (bar.below) draw_tip(picture, colors, colors.bottom, colors.bottom + tip, color_at(*bar.map, 0.0));
}

/// Of a bar of categories, where all have room.
std::optional<Swatches> swatches_of(int width, int height, const ColorBar& bar) {
  if (bar.categories.empty()) return std::nullopt;
  std::vector<Swatch> rows;
  for (const Category& c : bar.categories) {
    const double along = std::clamp((c.value - bar.low) / (bar.high - bar.low), 0.0, 1.0);
    rows.push_back({c.name, color_at(*bar.map, along)});
  }
  Swatches swatches(width, height, bar.title, std::move(rows));
  return swatches.fits() ? std::optional(std::move(swatches)) : std::nullopt;
}

void draw_bar(render::Picture& picture, const ColorBar& bar, const Rectangle& plate) {
  if (const std::optional<Swatches> swatches = swatches_of(picture.width, picture.height, bar))
    return swatches->draw(picture, plate);
  const BarLayout l = layout_of(picture.width, picture.height, bar);
  draw_plate(picture, plate);
  const TextStyle style{.height = l.text, .color = plate_ink};
  const double middle = 0.5 * (plate.left + plate.right);
  for (std::size_t i = 0; i < l.title.size(); ++i)
    draw_text(picture, middle - 0.5 * text_width(l.title[i], l.text),
              plate.top + l.pad + l.text * (1.0 + line_pitch * static_cast<double>(i)), l.title[i], style);
  const double x = std::round(middle - 0.5 * l.column()), y = std::round(plate.top + l.above_bar());
  const Rectangle colors{x, y, x + std::round(l.bar_width()), y + std::round(l.bar_height)};
  const double line = std::max(1.0, std::round(0.12 * l.unit));
  draw_colors(picture, bar, colors, line, l.tip());
  for (const BarLabel& label : l.labels.ticks) {
    const double along = (label.value - bar.low) / (bar.high - bar.low);
    const double at = colors.bottom - along * (colors.bottom - colors.top);
    fill_rectangle(picture, {colors.right, at - 0.5 * line, colors.right + l.tick(), at + 0.5 * line},
                   plate_ink);
    draw_text(picture, colors.right + l.gap(), at + 0.5 * l.text, label.text, style);
  }
}

}  // namespace

BarLabels labels_of(const ColorBar& bar, int steps, double apart) {
  const double size = std::max(std::abs(bar.low), std::abs(bar.high));
  const Prefix prefix = prefix_of(size, bar.unit);
  BarLabels labels{bar.title, {}};
  if (!bar.unit.empty()) labels.title += fmt::format(" ({}{})", prefix.name, bar.unit);
  const std::vector<double> places = ticks(bar.low / prefix.factor, bar.high / prefix.factor, steps);
  const double step = places[1] - places[0], slack = 1e-9 * (bar.high - bar.low);
  for (const double place : places) {
    const double value = place * prefix.factor;
    if (value < bar.low - slack || value > bar.high + slack) continue;
    labels.ticks.push_back(
        {std::clamp(value, bar.low, bar.high), number_text(place, step, size / prefix.factor)});
  }
  const BarLabel low{bar.low, end_text(bar.low / prefix.factor)},
      high{bar.high, end_text(bar.high / prefix.factor)};
  if (labels.ticks.size() < 2) labels.ticks = {low, high};
  const auto mark = [&](const BarLabel& end, const char* sign) {
    std::string text = end.text;
    std::erase_if(labels.ticks, [&](const BarLabel& label) {
      const double distance = std::abs(label.value - end.value);
      if (distance <= slack) text = label.text;
      return distance < apart * (bar.high - bar.low);
    });
    return BarLabel{end.value, sign + text};
  };
  if (bar.above) labels.ticks.push_back(mark(high, "\u2265"));
  if (bar.below) labels.ticks.insert(labels.ticks.begin(), mark(low, "\u2264"));
  return labels;
}

BarLabels labels_in(int width, int height, const ColorBar& bar) {
  return layout_of(width, height, bar).labels;
}

std::vector<Rectangle> place_color_bars(OverlayLayout& layout, const std::vector<ColorBar>& bars) {
  std::vector<Rectangle> plates;
  for (const ColorBar& bar : bars) {
    const BarLayout l = layout_of(layout.width(), layout.height(), bar);
    const std::optional<Swatches> swatches = swatches_of(layout.width(), layout.height(), bar);
    if (!swatches && l.width() > widest_labels * layout.width()) break;
    const std::optional<Rectangle> plate = swatches
                                               ? layout.take(swatches->width(), swatches->height(), "right")
                                               : layout.take(l.width(), l.height(), "right");
    if (!plate) break;
    plates.push_back(*plate);
  }
  return plates;
}

void draw_color_bars(render::Picture& picture, const std::vector<ColorBar>& bars,
                     const std::vector<Rectangle>& plates) {
  for (std::size_t i = 0; i < plates.size(); ++i) draw_bar(picture, bars[i], plates[i]);
}

double color_bar_strip(int width, int height, const std::vector<ColorBar>& bars) {
  OverlayLayout alone(width, height);
  double left = width;
  for (const Rectangle& plate : place_color_bars(alone, bars)) left = std::min(left, plate.left);
  return (width - left) / width;
}

}  // namespace lagomorph::apps
