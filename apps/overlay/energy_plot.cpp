#include "apps/overlay/energy_plot.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "apps/overlay/color_bar.h"
#include "apps/overlay/overlay.h"
#include "apps/overlay/shapes.h"
#include "apps/overlay/stroke_font.h"
#include "apps/overlay/ticks.h"

namespace lagomorph::apps {
namespace {

struct Curve {
  const char* key;
  const char* name;
  double EnergySample::*value;
  Color color;
};
/// Light ones of Okabe and Ito's, which colour-blind people tell apart; the total over the others.
constexpr std::array<Curve, 4> all_curves = {
    {{"kinetic", "kinetic", &EnergySample::kinetic, {86, 180, 233}},
     {"elastic", "elastic", &EnergySample::elastic, {230, 159, 0}},
     {"gravitational", "gravity", &EnergySample::gravitational, {64, 200, 150}},
     {"total", "total", &EnergySample::total, {244, 244, 246}}}};

using Curves = std::vector<Curve>;

/// Those of the diagram, in their own order.
Curves curves_of(const EnergyAxes& axes) {
  Curves some;
  for (const Curve& curve : all_curves)
    if (std::find(axes.curves.begin(), axes.curves.end(), curve.key) != axes.curves.end())
      some.push_back(curve);
  return some;
}

struct PlotLayout {
  double unit, text;
  Curves curves;
  std::size_t columns;  // of the legend
  double width, height;
  Rectangle plate;
  Rectangle box;  // of the curves
  double pad() const { return 1.2 * text; }
  double row() const { return 1.9 * text; }  // of the legend, from line to line
  std::size_t rows() const { return (curves.size() + columns - 1) / columns; }
  double x(const EnergyAxes& axes, double time) const {
    return box.left + (time - axes.time[0]) / (axes.time[1] - axes.time[0]) * (box.right - box.left);
  }
  double y(const EnergyAxes& axes, double energy) const {
    return box.bottom -
           (energy - axes.energy[0]) / (axes.energy[1] - axes.energy[0]) * (box.bottom - box.top);
  }
};

/// Never empty: around one value a tenth of it, above 0 one joule.
std::array<double, 2> to_round_numbers(std::array<double, 2> range) {
  const double size = std::max(std::abs(range[0]), std::abs(range[1]));
  if (size == 0.0) range = {0.0, 1.0};
  if (range[1] - range[0] <= 1e-9 * size) range = {range[0] - 0.1 * size, range[1] + 0.1 * size};
  const std::vector<double> steps = ticks(range[0], range[1], 4);
  return {std::min(range[0], steps.front()), std::max(range[1], steps.back())};
}

std::string time_text(double time) { return fmt::format("{:.4g}", time); }

double entry_width(const Curve& curve, double text) { return text_width(curve.name, text) + 2.2 * text; }

/// Of each of the legend's columns.
std::vector<double> column_widths(const Curves& curves, std::size_t columns, double text) {
  std::vector<double> widths(columns, 0.0);
  for (std::size_t i = 0; i < curves.size(); ++i)
    widths[i % columns] = std::max(widths[i % columns], entry_width(curves[i], text));
  return widths;
}

double legend_width(const Curves& curves, std::size_t columns, double text) {
  double width = 1.2 * text * static_cast<double>(columns - 1);
  for (const double column : column_widths(curves, columns, text)) width += column;
  return width;
}

BarLabels energy_labels(const EnergyAxes& axes) {
  return labels_of({"energy", "J", nullptr, axes.energy[0], axes.energy[1]}, 4);
}

EnergyAxes rounded_axes(const EnergyAxes& given) {
  EnergyAxes axes = given;
  if (!given.given) axes.energy = to_round_numbers(given.energy);
  return axes;
}

/// The legend takes two rows where letters have their least size.
PlotLayout plot_layout(int width, int height, const EnergyAxes& axes, const BarLabels& labels) {
  PlotLayout l{};
  l.curves = curves_of(axes);
  l.unit = overlay_unit(width, height);
  l.text = std::max(6.0, 0.82 * overlay_text_height(width, height));
  double numbers = 0.0;
  for (const BarLabel& label : labels.ticks) numbers = std::max(numbers, text_width(label.text, l.text));
  const double beside = std::round(numbers + l.text);
  l.columns = l.curves.size();
  if (legend_width(l.curves, l.columns, l.text) > beside + 42.0 * l.unit) l.columns = (l.columns + 1) / 2;
  const double inner = std::max(38.0 * l.unit, legend_width(l.curves, l.columns, l.text) - beside);
  l.width = std::round(2.0 * l.pad() + beside + inner);
  const double above = 2.5 * l.text + l.row() * static_cast<double>(l.rows());  // title and legend
  l.height = std::round(2.0 * l.pad() + above + 19.0 * l.unit + 2.2 * l.text);
  l.box = {std::round(l.pad() + beside), std::round(l.pad() + above), std::round(l.width - l.pad()),
           std::round(l.height - l.pad() - 2.2 * l.text)};
  return l;
}

PlotLayout layout_on(const Rectangle& plate, const render::Picture& picture, const EnergyAxes& axes,
                     const BarLabels& labels) {
  PlotLayout l = plot_layout(picture.width, picture.height, axes, labels);
  l.plate = plate;
  l.box = {plate.left + l.box.left, plate.top + l.box.top, plate.left + l.box.right,
           plate.top + l.box.bottom};
  return l;
}

void draw_legend(render::Picture& picture, const PlotLayout& l) {
  const std::vector<double> widths = column_widths(l.curves, l.columns, l.text);
  const double left = l.plate.left + l.pad(), right = l.box.right;
  double gap = right - left;
  for (const double width : widths) gap -= width;
  gap /= static_cast<double>(std::max<std::size_t>(l.columns, 2) - 1);
  double x = left;
  for (std::size_t i = 0; i < l.curves.size(); ++i) {
    const std::size_t column = i % l.columns, row = i / l.columns;
    if (column == 0) x = left;
    const double y = l.plate.top + l.pad() + 2.9 * l.text + l.row() * static_cast<double>(row);
    const std::array<Segment, 1> sample = {{{{x, y - 0.5 * l.text}, {x + 1.5 * l.text, y - 0.5 * l.text}}}};
    draw_strokes(picture, sample, std::max(1.5, 0.22 * l.text), l.curves[i].color);
    draw_text(picture, x + 2.2 * l.text, y, l.curves[i].name, {.height = l.text, .color = plate_ink});
    x += widths[column] + gap;
  }
}

void draw_axes(render::Picture& picture, const PlotLayout& l, const EnergyAxes& axes,
               const BarLabels& labels) {
  const TextStyle style{.height = l.text, .color = plate_ink};
  const double line = std::max(1.0, std::round(0.1 * l.unit));
  for (const BarLabel& label : labels.ticks) {
    const double y = l.y(axes, label.value);
    fill_rectangle(picture, {l.box.left, y - 0.5 * line, l.box.right, y + 0.5 * line}, plate_ink, 0.16);
    draw_text(picture, l.box.left - 0.7 * l.text - text_width(label.text, l.text), y + 0.5 * l.text,
              label.text, style);
  }
  fill_rectangle(picture, {l.box.left, l.box.bottom - line, l.box.right, l.box.bottom}, plate_ink, 0.7);
  fill_rectangle(picture, {l.box.left, l.box.top, l.box.left + line, l.box.bottom}, plate_ink, 0.7);
  const std::string unit = "time (s)";
  const double words = l.box.right - text_width(unit, l.text);
  for (const double time : ticks(axes.time[0], axes.time[1], 4)) {
    if (time < axes.time[0] || time > axes.time[1] * (1.0 + 1e-9)) continue;
    const double x = l.x(axes, time), half = 0.5 * text_width(time_text(time), l.text);
    fill_rectangle(picture, {x - 0.5 * line, l.box.bottom, x + 0.5 * line, l.box.bottom + 0.5 * l.text},
                   plate_ink, 0.7);
    if (x + half < words - l.text)
      draw_text(picture, x - half, l.box.bottom + 2.1 * l.text, time_text(time), style);
  }
  draw_text(picture, words, l.box.bottom + 2.1 * l.text, unit, style);
}

/// What of a segment lies between two heights; none where it is beyond.
std::optional<Segment> between_heights(Segment s, double top, double bottom) {
  const Point a = s.a, b = s.b;
  if (std::max(a.y, b.y) < top || std::min(a.y, b.y) > bottom) return std::nullopt;
  const auto to = [&](const Point& end) {
    const double y = std::clamp(end.y, top, bottom);
    return y == end.y ? end : Point{a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x), y};
  };
  return Segment{to(a), to(b)};
}

}  // namespace

std::vector<std::string> energy_curves() {
  std::vector<std::string> names;
  names.reserve(all_curves.size());
  for (const Curve& curve : all_curves) names.emplace_back(curve.key);
  return names;
}

double energy_of(const EnergySample& sample, const std::string& name) {
  for (const Curve& curve : all_curves)
    if (name == curve.key) return sample.*curve.value;
  return 0.0;
}

std::optional<Rectangle> place_energy_plot(OverlayLayout& layout, const EnergyAxes& axes,
                                           const std::string& place) {
  const EnergyAxes rounded = rounded_axes(axes);
  const PlotLayout l = plot_layout(layout.width(), layout.height(), rounded, energy_labels(rounded));
  return layout.take(l.width, l.height, place);
}

void draw_energy_plot(render::Picture& picture, const std::vector<EnergySample>& samples,
                      const EnergyAxes& given, const Rectangle& plate) {
  const EnergyAxes axes = rounded_axes(given);
  const BarLabels labels = energy_labels(axes);
  const PlotLayout l = layout_on(plate, picture, axes, labels);
  draw_plate(picture, plate);
  draw_text(picture, plate.left + l.pad(), plate.top + l.pad() + l.text, labels.title,
            {.height = l.text, .color = plate_ink});
  draw_legend(picture, l);
  draw_axes(picture, l, axes, labels);
  const double width = std::max(1.4, 0.28 * l.unit);
  for (const Curve& curve : l.curves) {
    constexpr double slack = 1e-6;  // ends of the axis are not lost by rounding
    const double top = l.box.top - slack, bottom = l.box.bottom + slack;
    std::vector<Segment> line;
    const auto at = [&](const EnergySample& s) {
      return Point{l.x(axes, s.time), l.y(axes, s.*curve.value)};
    };
    for (std::size_t i = 1; i < samples.size(); ++i)
      if (const auto seen = between_heights({at(samples[i - 1]), at(samples[i])}, top, bottom))
        line.push_back(*seen);
    draw_strokes(picture, line, width, curve.color);
    if (samples.empty()) continue;
    const Point last = at(samples.back());
    if (last.y >= top && last.y <= bottom) fill_disc(picture, last, 1.25 * width, curve.color);
  }
}

}  // namespace lagomorph::apps
