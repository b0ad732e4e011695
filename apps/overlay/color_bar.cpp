#include "apps/overlay/color_bar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

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

/// A bar in the picture.
struct BarLayout {
  double unit, text, pad;
  double title_width, labels_width;

  double tick() const { return 0.9 * unit; }
  double bar_width() const { return 3.0 * unit; }
  double bar_height() const { return 42.0 * unit; }
  double column() const { return bar_width() + 2.2 * tick() + labels_width; }
  double width() const { return 2.0 * pad + std::max(title_width, column()); }
  double height() const { return 2.5 * pad + text + bar_height() + 0.5 * text + pad; }
};

BarLayout layout_of(const render::Picture& picture, const BarLabels& labels) {
  BarLayout l{overlay_unit(picture), overlay_text_height(picture), 0, 0, 0};
  l.pad = 1.2 * l.text;
  l.title_width = text_width(labels.title, l.text);
  for (const BarLabel& label : labels.ticks)
    l.labels_width = std::max(l.labels_width, text_width(label.text, l.text));
  return l;
}

void draw_gradient(render::Picture& picture, const Rectangle& bar, const render::Colormap& map) {
  for (double y = bar.top; y < bar.bottom; y = std::floor(y) + 1.0) {
    const double end = std::min(std::floor(y) + 1.0, bar.bottom);
    const double value = (bar.bottom - 0.5 * (y + end)) / (bar.bottom - bar.top);
    const std::array<float, 3> rgb = render::srgb_of(map, static_cast<float>(value));
    Color color;
    for (std::size_t i = 0; i < 3; ++i) color[i] = static_cast<std::uint8_t>(std::lround(255.0F * rgb[i]));
    fill_rectangle(picture, {bar.left, y, bar.right, end}, color);
  }
}

void draw_bar(render::Picture& picture, const ColorBar& bar, const BarLabels& labels, const BarLayout& l,
              double left, double top) {
  draw_plate(picture, {left, top, left + l.width(), top + l.height()});
  const TextStyle style{.height = l.text, .color = plate_ink};
  draw_text(picture, left + l.pad, top + l.pad + l.text, labels.title, style);
  const double x = std::round(left + 0.5 * (l.width() - l.column())),
               y = std::round(top + 2.5 * l.pad + l.text);
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

double draw_color_bars(render::Picture& picture, const std::vector<ColorBar>& bars) {
  const double margin = 3.0 * overlay_unit(picture);
  double right = picture.width - margin;
  for (const ColorBar& bar : bars) {
    const BarLabels labels = labels_of(bar);
    const BarLayout l = layout_of(picture, labels);
    const double left = std::round(right - l.width()), top = std::round(0.5 * (picture.height - l.height()));
    if (left < 0.0 || top < 0.0) break;
    draw_bar(picture, bar, labels, l, left, top);
    right = left - 0.5 * margin;
  }
  return picture.width - margin - right;
}

}  // namespace lagomorph::apps
