#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "apps/check/probe.h"

namespace lagomorph::apps {
namespace {

constexpr int levels = 256;
constexpr double unexplained = 0.05;  // of the squared difference, at most

/// Of the pixels of one level in the golden: how many, and what became of them.
struct Level {
  double count = 0, sum = 0, squares = 0;
  double mean() const { return sum / count; }
};
using Curve = std::array<Level, levels>;

std::array<Curve, 3> curves_of(const render::Pixels& golden, const render::Pixels& fresh) {
  std::array<Curve, 3> curves{};
  const auto step = static_cast<std::size_t>(golden.samples_per_pixel());
  std::visit(
      [&](const auto& from) {
        const auto& to = std::get<std::decay_t<decltype(from)>>(fresh.samples);
        const unsigned shift = golden.bit_depth() == 16 ? 8U : 0U;
        for (std::size_t i = 0; i < from.size(); i += step) {
          for (std::size_t c = 0; c < 3; ++c) {
            Level& level = curves[c][static_cast<std::size_t>(from[i + c] >> shift)];
            const double value = to[i + c] >> shift;
            level.count += 1;
            level.sum += value;
            level.squares += value * value;
          }
        }
      },
      golden.samples);
  return curves;
}

/// Squared difference of what became of the pixels to what `change` makes of their levels.
double error(const Curve& curve, const std::function<double(double)>& change) {
  double sum = 0;
  for (int v = 0; v < levels; ++v) {
    const Level& l = curve[static_cast<std::size_t>(v)];
    if (l.count == 0) continue;
    const double made = std::clamp(change(v), 0.0, 255.0);
    sum += l.squares - 2 * made * l.sum + made * made * l.count;
  }
  return sum;
}

/// Levels whose means are not clipped, by weight(v, mean) of numerator and denominator.
double ratio(const Curve& curve, const std::function<std::array<double, 2>(double, double)>& terms) {
  double top = 0, bottom = 0;
  for (int v = 8; v < 248; ++v) {
    const Level& l = curve[static_cast<std::size_t>(v)];
    if (l.count == 0 || l.mean() < 2 || l.mean() > 253) continue;
    const auto [t, b] = terms(v, l.mean());
    top += l.count * t;
    bottom += l.count * b;
  }
  return bottom == 0 ? std::nan("") : top / bottom;
}

/// One parameter a channel and the error that it leaves.
struct Fit {
  std::array<double, 3> parameter{};
  double left = 0;
};

Fit fit_gain(const std::array<Curve, 3>& curves) {
  Fit fit;
  for (std::size_t c = 0; c < 3; ++c) {
    const double g = ratio(curves[c], [](double v, double m) { return std::array{v * m, v * v}; });
    fit.parameter[c] = g;
    fit.left += error(curves[c], [g](double v) { return g * v; });
  }
  return fit;
}

Fit fit_offset(const std::array<Curve, 3>& curves) {
  Fit fit;
  for (std::size_t c = 0; c < 3; ++c) {
    const double o = ratio(curves[c], [](double v, double m) { return std::array{m - v, 1.0}; });
    fit.parameter[c] = o;
    fit.left += error(curves[c], [o](double v) { return v + o; });
  }
  return fit;
}

/// One gamma for all channels: new = golden^(1 / gamma).
Fit fit_gamma(const std::array<Curve, 3>& curves) {
  double top = 0, bottom = 0;
  for (const Curve& curve : curves) {
    const double e = ratio(curve, [](double v, double m) {
      return std::array{std::log(m / 255) * std::log(v / 255), std::log(v / 255) * std::log(v / 255)};
    });
    if (std::isnan(e)) continue;
    top += e;
    bottom += 1;
  }
  const double exponent = top / bottom;
  Fit fit{{1 / exponent, 1 / exponent, 1 / exponent}, 0};
  for (const Curve& curve : curves)
    fit.left += error(curve, [&](double v) { return 255 * std::pow(v / 255, exponent); });
  return fit;
}

/// "red times 0.9, blue times 1.1"; of channels that changed alike "times 1.2".
std::string by_channel(const Fit& fit, double neutral, const char* format) {
  constexpr std::array<const char*, 3> names = {"red ", "green ", "blue "};
  const auto& p = fit.parameter;
  const auto text = [&](double value) { return fmt::format(fmt::runtime(format), value); };
  if (text(p[0]) == text(p[1]) && text(p[1]) == text(p[2])) return text(p[0]);
  std::string all;
  for (std::size_t c = 0; c < 3; ++c) {
    if (text(p[c]) != text(neutral)) all += (all.empty() ? "" : ", ") + (names[c] + text(p[c]));
  }
  return all;
}

}  // namespace

std::string find_tone(const render::Pixels& golden, const render::Pixels& fresh) {
  const std::array<Curve, 3> curves = curves_of(golden, fresh);
  double all = 0, own = 0;
  for (const Curve& curve : curves) {
    all += error(curve, [](double v) { return v; });
    own += error(curve, [&](double v) { return curve[static_cast<std::size_t>(v)].mean(); });
  }
  const double least = unexplained * all;
  const auto explains = [&](const Fit& fit) { return fit.left <= least; };  // a NaN does not
  const Fit offset = fit_offset(curves), gain = fit_gain(curves), gamma = fit_gamma(curves);
  const double best = std::min({offset.left, gain.left, gamma.left});
  if (all == 0) return "";
  if (explains(offset) && offset.left == best) return by_channel(offset, 0, "{:+.3g} of 255");
  if (explains(gain) && gain.left == best) return by_channel(gain, 1, "times {:.3g}");
  if (explains(gamma) && gamma.left == best) return fmt::format("gamma {:.3g}", gamma.parameter[0]);
  return own <= least ? "another tone curve" : "";
}

}  // namespace lagomorph::apps
