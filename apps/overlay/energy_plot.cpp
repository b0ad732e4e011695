#include "apps/overlay/energy_plot.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "apps/overlay/color_bar.h"
#include "apps/overlay/overlay.h"
#include "apps/overlay/shapes.h"
#include "apps/overlay/stroke_font.h"
#include "apps/overlay/ticks.h"

namespace lagomorph::apps {
namespace {

struct Curve {
  const char* name;
  double EnergySample::*value;
  Color color;
};
/// Light ones of Okabe and Ito's, which colour-blind people tell apart; the total over the others.
constexpr std::array<Curve, 4> curves = {{{"kinetic", &EnergySample::kinetic, {86, 180, 233}},
                                          {"elastic", &EnergySample::elastic, {230, 159, 0}},
                                          {"gravity", &EnergySample::gravitational, {64, 200, 150}},
                                          {"total", &EnergySample::total, {244, 244, 246}}}};

struct PlotLayout {
  double unit, text;
  double left, top, width, height;  // of the plate
  Rectangle box;                    // of the curves
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

/// The gaps between its entries left out.
double legend_width(double text) {
  double width = 0.0;
  for (const Curve& curve : curves) width += text_width(curve.name, text) + 2.2 * text;
  return width;
}

PlotLayout layout_of(const render::Picture& picture, const BarLabels& labels, std::string_view place,
                     double above, double beside) {
  PlotLayout l{};
  l.unit = overlay_unit(picture);
  l.text = 0.82 * overlay_text_height(picture);
  double numbers = 0.0;
  for (const BarLabel& label : labels.ticks) numbers = std::max(numbers, text_width(label.text, l.text));
  const double pad = 1.2 * l.text;
  const double legend = legend_width(l.text) + 1.2 * l.text * (curves.size() - 1);
  const double inner_width = std::round(std::max(38.0 * l.unit, legend - numbers - l.text)),
               inner_height = std::round(19.0 * l.unit);
  l.width = std::round(2.0 * pad + numbers + l.text + inner_width);
  l.height = std::round(2.0 * pad + 4.4 * l.text + inner_height + 2.2 * l.text);
  const double margin = 3.0 * l.unit;
  l.left = std::round(0.5 * (picture.width - l.width));
  if (place.ends_with("left")) l.left = std::round(margin);
  if (place.ends_with("right")) l.left = std::round(picture.width - margin - beside - l.width);
  l.top = std::round(place.starts_with("top") ? margin + above : picture.height - margin - above - l.height);
  l.box.left = std::round(l.left + pad + numbers + l.text);
  l.box.right = l.box.left + inner_width;
  l.box.top = std::round(l.top + pad + 4.4 * l.text);
  l.box.bottom = l.box.top + inner_height;
  return l;
}

void draw_legend(render::Picture& picture, const PlotLayout& l) {
  const double pad = 1.2 * l.text, y = l.top + pad + 2.9 * l.text;
  const double left = l.left + pad, right = l.left + l.width - pad;
  const double gap = (right - left - legend_width(l.text)) / (curves.size() - 1);
  double x = left;
  for (const Curve& curve : curves) {
    const std::array<Segment, 1> sample = {{{{x, y - 0.5 * l.text}, {x + 1.5 * l.text, y - 0.5 * l.text}}}};
    draw_strokes(picture, sample, std::max(1.5, 0.22 * l.text), curve.color);
    draw_text(picture, x + 2.2 * l.text, y, curve.name, {.height = l.text, .color = plate_ink});
    x += 2.2 * l.text + text_width(curve.name, l.text) + gap;
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

}  // namespace

void draw_energy_plot(render::Picture& picture, const std::vector<EnergySample>& samples,
                      const EnergyAxes& given, const std::string& place, double above, double beside) {
  const EnergyAxes axes{.time = given.time, .energy = to_round_numbers(given.energy)};
  const BarLabels labels = labels_of({"energy", "J", nullptr, axes.energy[0], axes.energy[1]}, 4);
  const PlotLayout l = layout_of(picture, labels, place, above, beside);
  if (l.left < 0.0 || l.top < 0.0 || l.left + l.width > picture.width || l.top + l.height > picture.height)
    return;
  draw_plate(picture, {l.left, l.top, l.left + l.width, l.top + l.height});
  const double pad = 1.2 * l.text;
  draw_text(picture, l.left + pad, l.top + pad + l.text, labels.title,
            {.height = l.text, .color = plate_ink});
  draw_legend(picture, l);
  draw_axes(picture, l, axes, labels);
  const double width = std::max(1.4, 0.28 * l.unit);
  for (const Curve& curve : curves) {
    std::vector<Segment> line;
    const auto at = [&](const EnergySample& s) {
      return Point{l.x(axes, s.time), std::clamp(l.y(axes, s.*curve.value), l.box.top, l.box.bottom)};
    };
    for (std::size_t i = 1; i < samples.size(); ++i) line.push_back({at(samples[i - 1]), at(samples[i])});
    draw_strokes(picture, line, width, curve.color);
    if (!samples.empty()) fill_disc(picture, at(samples.back()), 1.25 * width, curve.color);
  }
}

}  // namespace lagomorph::apps
