#include "apps/overlay/color_bar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "apps/overlay/overlay.h"
#include "apps/overlay/stroke_font.h"
#include "apps/overlay/ticks.h"

namespace lagomorph::apps {
namespace {

struct Prefix {
  const char* name;
  double factor;
};

/// That of a value's thousands; none beyond them, for pure numbers, and of units that have one.
Prefix prefix_of(double size, const std::string& unit) {
  constexpr std::array<Prefix, 7> prefixes = {
      {{"G", 1e9}, {"M", 1e6}, {"k", 1e3}, {"", 1.0}, {"m", 1e-3}, {"u", 1e-6}, {"n", 1e-9}}};
  if (unit.empty() || unit.starts_with("k") || size >= 1e12) return {"", 1.0};
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

constexpr double line_pitch = 1.7;  // of a title's lines, over their height

/// A bar on its plate.
struct BarLayout {
  double unit, text, pad;
  std::vector<std::string> title;  // a line each
  double title_width, labels_width;

  double tick() const { return 0.9 * unit; }
  double bar_width() const { return 3.0 * unit; }
  double bar_height() const { return 42.0 * unit; }
  double column() const { return bar_width() + 2.2 * tick() + labels_width; }
  double width() const { return 2.0 * pad + std::max(title_width, column()); }
  double title_height() const { return text * (1.0 + line_pitch * static_cast<double>(title.size() - 1)); }
  double height() const { return 2.5 * pad + title_height() + bar_height() + 0.5 * text + pad; }
};

/// A title that is wider than `width` in two lines, broken at the blank that makes them as narrow as can be.
std::vector<std::string> title_lines(const std::string& title, double height, double width) {
  double least = text_width(title, height);
  std::vector<std::string> lines = {title};
  if (least <= width) return lines;
  for (std::size_t at = title.find(' '); at != std::string::npos; at = title.find(' ', at + 1)) {
    std::vector<std::string> two = {title.substr(0, at), title.substr(at + 1)};
    const double wide = std::max(text_width(two[0], height), text_width(two[1], height));
    if (wide >= least) continue;
    least = wide;
    lines = std::move(two);
  }
  return lines;
}

BarLayout layout_of(int width, int height, const BarLabels& labels) {
  BarLayout l{overlay_unit(width, height), overlay_text_height(width, height), 0, {}, 0, 0};
  l.pad = 1.2 * l.text;
  for (const BarLabel& label : labels.ticks)
    l.labels_width = std::max(l.labels_width, text_width(label.text, l.text));
  l.title = title_lines(labels.title, l.text, l.column());
  for (const std::string& line : l.title) l.title_width = std::max(l.title_width, text_width(line, l.text));
  return l;
}

void draw_gradient(render::Picture& picture, const Rectangle& bar, const render::Colormap& map) {
  double y = bar.top;
  while (y < bar.bottom) {
    const double end = std::min(std::floor(y) + 1.0, bar.bottom);
    const double value = (bar.bottom - 0.5 * (y + end)) / (bar.bottom - bar.top);
    const std::array<float, 3> rgb = render::srgb_of(map, static_cast<float>(value));
    Color color;
    for (std::size_t i = 0; i < 3; ++i) color[i] = static_cast<std::uint8_t>(std::lround(255.0F * rgb[i]));
    fill_rectangle(picture, {bar.left, y, bar.right, end}, color);
    y = end;
  }
}

void draw_bar(render::Picture& picture, const ColorBar& bar, const Rectangle& plate) {
  const BarLabels labels = labels_of(bar);
  const BarLayout l = layout_of(picture.width, picture.height, labels);
  draw_plate(picture, plate);
  const TextStyle style{.height = l.text, .color = plate_ink};
  const double middle = 0.5 * (plate.left + plate.right);
  for (std::size_t i = 0; i < l.title.size(); ++i)
    draw_text(picture, middle - 0.5 * text_width(l.title[i], l.text),
              plate.top + l.pad + l.text * (1.0 + line_pitch * static_cast<double>(i)), l.title[i], style);
  const double x = std::round(middle - 0.5 * l.column()),
               y = std::round(plate.top + 2.5 * l.pad + l.title_height());
  const Rectangle colors{x, y, x + std::round(l.bar_width()), y + std::round(l.bar_height())};
  const double line = std::max(1.0, std::round(0.12 * l.unit));
  fill_rectangle(picture, {x - line, y - line, colors.right + line, colors.bottom + line}, plate_ink, 0.5);
  draw_gradient(picture, colors, *bar.map);
  for (const BarLabel& label : labels.ticks) {
    const double along = (label.value - bar.low) / (bar.high - bar.low);
    const double at = colors.bottom - along * (colors.bottom - colors.top);
    fill_rectangle(picture, {colors.right, at - 0.5 * line, colors.right + l.tick(), at + 0.5 * line},
                   plate_ink);
    draw_text(picture, colors.right + 2.2 * l.tick(), at + 0.5 * l.text, label.text, style);
  }
}

}  // namespace

BarLabels labels_of(const ColorBar& bar, int steps) {
  const double size = std::max(std::abs(bar.low), std::abs(bar.high));
  const Prefix prefix = prefix_of(size, bar.unit);
  BarLabels labels{bar.title, {}};
  if (!bar.unit.empty()) labels.title += fmt::format(" ({}{})", prefix.name, bar.unit);
  const std::vector<double> places = ticks(bar.low / prefix.factor, bar.high / prefix.factor, steps);
  const double step = places[1] - places[0];
  for (const double place : places) {
    const double value = place * prefix.factor, slack = 1e-9 * (bar.high - bar.low);
    if (value < bar.low - slack || value > bar.high + slack) continue;
    labels.ticks.push_back(
        {std::clamp(value, bar.low, bar.high), number_text(place, step, size / prefix.factor)});
  }
  return labels;
}

std::vector<Rectangle> place_color_bars(OverlayLayout& layout, const std::vector<ColorBar>& bars) {
  std::vector<Rectangle> plates;
  for (const ColorBar& bar : bars) {
    const BarLayout l = layout_of(layout.width(), layout.height(), labels_of(bar));
    const std::optional<Rectangle> plate = layout.take(l.width(), l.height(), "right");
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
