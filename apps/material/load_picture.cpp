#include "apps/material/load_picture.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "apps/overlay/ticks.h"

namespace lagomorph::apps {
namespace {

constexpr double width = 380.0, height = 260.0;                          // of a panel, in pixels
constexpr double left = 70.0, right = 15.0, above = 40.0, below = 45.0;  // of its axes

/// One panel's scales: data to pixels.
class Panel {
public:
  Panel(const LoadCurve& curve, double x, double y) : x_(x), y_(y) {
    double low = 0.0, high = 0.0;
    for (const LoadPoint& p : curve.points) {
      if (!std::isfinite(p.stress)) continue;
      low = std::min({low, p.stress, p.closed_form});
      high = std::max({high, p.stress, p.closed_form});
    }
    across_ = ticks(curve.points.front().stretch, curve.points.back().stretch);
    up_ = ticks(low, high > low ? high : low + 1.0);
  }

  double x(double stretch) const {
    return x_ + left +
           (width - left - right) * (stretch - across_.front()) / (across_.back() - across_.front());
  }
  double y(double stress) const {
    return y_ + height - below -
           (height - above - below) * (stress - up_.front()) / (up_.back() - up_.front());
  }

  std::string grid() const {
    std::string svg;
    for (const double t : across_)
      svg += line(x(t), y(up_.front()), x(t), y(up_.back())) +
             text(x(t), y(up_.front()) + 16.0, "middle", fmt::format("{:g}", rounded(t)));
    for (const double t : up_)
      svg += line(x(across_.front()), y(t), x(across_.back()), y(t)) +
             text(x(across_.front()) - 6.0, y(t) + 4.0, "end", fmt::format("{:g}", rounded(t)));
    return svg;
  }
  std::string titles(const LoadCurve& curve) const {
    return text(x_ + left, y_ + above - 12.0, "start",
                fmt::format("<tspan font-weight=\"bold\">{}</tspan>: {} [Pa]", curve.loading, curve.stress)) +
           text(x_ + 0.5 * (left + width - right), y_ + height - 10.0, "middle", curve.deformation);
  }
  std::string curves(const LoadCurve& curve) const {
    std::string path, rings;
    bool drawing = false;  // a point without an equilibrium breaks the line
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const LoadPoint& p = curve.points[i];
      if (!std::isfinite(p.stress)) {
        drawing = false;
        continue;
      }
      path += fmt::format("{}{:.2f},{:.2f} ", drawing ? "L" : "M", x(p.stretch), y(p.stress));
      drawing = true;
      rings += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3\"/>", x(p.stretch), y(p.closed_form));
    }
    return fmt::format(
        "<path d=\"{}\" fill=\"none\" stroke=\"#1f5fa8\" stroke-width=\"2\"/>\n"
        "<g fill=\"none\" stroke=\"#c2571a\">{}</g>\n",
        path, rings);
  }

private:
  static double rounded(double t) { return std::abs(t) < 1e-9 ? 0.0 : t; }
  static std::string line(double x0, double y0, double x1, double y1) {
    return fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"#ddd\"/>\n",
                       x0, y0, x1, y1);
  }
  static std::string text(double x, double y, const char* anchor, const std::string& words) {
    return fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, words);
  }

  double x_, y_;  // of its upper left corner, in pixels
  std::vector<double> across_, up_;
};

}  // namespace

std::string load_svg(const std::string& model, const std::vector<LoadCurve>& curves) {
  const double rows = std::ceil(0.5 * static_cast<double>(curves.size()));
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n"
      "<text x=\"{2}\" y=\"18\" font-size=\"14\">{3}: first Piola-Kirchhoff stress; rings: closed "
      "form</text>\n",
      2.0 * width, rows * height + 20.0, left, model);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const std::size_t row = i / 2, column = i % 2;
    const Panel panel(curves[i], width * static_cast<double>(column),
                      20.0 + height * static_cast<double>(row));
    svg += panel.grid() + panel.titles(curves[i]) + panel.curves(curves[i]);
  }
  return svg + "</svg>\n";
}

}  // namespace lagomorph::apps
