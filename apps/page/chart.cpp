#include "apps/page/chart.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "apps/overlay/ticks.h"
#include "apps/page/html.h"

namespace lagomorph::apps {
namespace {

constexpr double width = 1000, height = 300;  // of the drawing; it is stretched
constexpr std::size_t most_points = 600;

struct Range {
  double low = 0, high = 0;
  double at(double value) const { return high > low ? (value - low) / (high - low) : 0.5; }
};

std::string number(double value) {
  const std::string text = fmt::format("{:.4g}", std::abs(value) < 1e-12 ? 0.0 : value);
  return text.starts_with("-") ? fmt::format("−{}", std::string_view(text).substr(1)) : text;
}

/// Of long runs every so many-th place.
std::size_t stride_of(const Chart& chart) { return (chart.frames.size() + most_points - 1) / most_points; }

Range range_of(const Chart& chart) {
  Range range{0, 0};
  for (std::size_t i = 0; i < chart.frames.size(); ++i) {
    double sum = 0;
    for (const Series& s : chart.series) {
      sum = chart.bars ? sum + s.values[i] : s.values[i];
      range.low = std::min(range.low, sum), range.high = std::max(range.high, sum);
    }
  }
  if (range.high == range.low) range.high = range.low + 1;
  return range;
}

double x_of(const Chart& chart, double frame) {
  const Range frames{chart.frames.front() - (chart.bars ? 0.5 : 0.0),
                     chart.frames.back() + (chart.bars ? 0.5 : 0.0)};
  return frames.at(frame);
}

std::string lines(const Chart& chart, const Range& y) {
  std::string svg;
  for (const Series& s : chart.series) {
    std::string points;
    const std::size_t stride = stride_of(chart);
    for (std::size_t i = 0; i < chart.frames.size(); i += stride)
      points += fmt::format("{:.1f},{:.1f} ", width * x_of(chart, chart.frames[i]),
                            height * (1 - y.at(s.values[i])));
    svg += fmt::format("<polyline class=\"{}\" points=\"{}\"/>", s.color, points);
  }
  return svg;
}

std::string bars(const Chart& chart, const Range& y) {
  std::vector<double> base(chart.frames.size(), 0.0);
  const std::size_t stride = stride_of(chart);
  const double half = 0.42 * static_cast<double>(stride);
  std::string svg;
  for (const Series& s : chart.series) {
    std::string path;
    for (std::size_t i = 0; i < chart.frames.size(); i += stride) {
      const double left = width * x_of(chart, chart.frames[i] - half),
                   right = width * x_of(chart, chart.frames[i] + half);
      const double bottom = height * (1 - y.at(base[i])), top = height * (1 - y.at(base[i] + s.values[i]));
      base[i] += s.values[i];
      if (s.values[i] > 0)
        path += fmt::format("M{:.1f} {:.1f}H{:.1f}V{:.1f}H{:.1f}Z", left, bottom, right, top, left);
    }
    svg += fmt::format("<path class=\"{}\" d=\"{}\"/>", s.color, path);
  }
  return svg;
}

/// The values, for the script that tells those of the frame that is shown.
std::string values_text(const std::vector<double>& values) {
  std::string text;
  for (const double v : values) text += fmt::format("{}{:.4g}", text.empty() ? "" : " ", v);
  return text;
}

std::string legend(const Chart& chart) {
  std::string html;
  for (const Series& s : chart.series) {
    html += fmt::format("<li class=\"{}\"><i></i>{} <output data-values=\"{}\"></output></li>", s.color,
                        html_text(s.name), values_text(s.values));
  }
  return html;
}

std::string frame_list(const std::vector<int>& frames) { return fmt::format("{}", fmt::join(frames, " ")); }

}  // namespace

std::string chart_html(const Chart& chart) {
  const Range values = range_of(chart);
  const std::vector<double> y_ticks = ticks(values.low, values.high);
  const Range y{y_ticks.front(), y_ticks.back()};
  std::string grid, y_labels, x_labels;
  for (const double tick : y_ticks) {
    const double v = height * (1 - y.at(tick));
    grid += fmt::format("<path class=\"{}\" d=\"M0 {:.1f}H{}\"/>", tick == 0 ? "zero" : "grid", v, width);
    y_labels += fmt::format("<span style=\"bottom:{:.2f}%\">{}</span>", 100 * y.at(tick), number(tick));
  }
  const double first = chart.frames.front() / chart.fps, last = chart.frames.back() / chart.fps;
  for (const double t : last > first ? ticks(first, last) : std::vector<double>{first}) {
    const double x = x_of(chart, t * chart.fps);
    if (x < -1e-9 || x > 1 + 1e-9) continue;
    x_labels += fmt::format("<span style=\"left:{:.2f}%\">{}{}</span>", 100 * x, number(t), chart.x_unit);
  }
  return fmt::format(
      "<figure class=\"chart\" data-frames=\"{}\" data-bars=\"{}\"><figcaption><b>{}</b> <span>{}</span>"
      "<ul>{}</ul></figcaption><div class=\"plot\"><div class=\"y\">{}</div><div class=\"area\">"
      "<svg viewBox=\"0 0 {} {}\" preserveAspectRatio=\"none\" role=\"img\" aria-label=\"{}\">{}{}</svg>"
      "<i class=\"now\" hidden></i></div><div class=\"x\">{}</div></div></figure>\n",
      frame_list(chart.frames), chart.bars ? 1 : 0, html_text(chart.title), html_text(chart.unit),
      legend(chart), y_labels, width, height, html_text(chart.title), grid,
      chart.bars ? bars(chart, y) : lines(chart, y), x_labels);
}

}  // namespace lagomorph::apps
