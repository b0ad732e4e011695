#include "apps/check/limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "render/image_compare/gate.h"

namespace lagomorph::apps {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

constexpr LimitRow rows[limit_count] = {
    {"flip_tile_max", false, 0, 1, "",
     "largest mean FLIP of a tile of 16x16 pixels; also of alpha's differences"},
    {"flip_mean", false, 0, 1, "", "mean FLIP; also of alpha's differences"},
    {"flip_max", false, 0, 1, "", "largest FLIP of a pixel"},
    {"max_abs", false, 0, 1, "full scale", "largest difference of a sample, alpha's too"},
    {"mean_abs", false, 0, 1, "full scale", "mean absolute difference"},
    {"rmse", false, 0, 1, "full scale", "root mean square difference"},
    {"pixels", false, 0, 1, "of all", "share of the pixels that differ at all"},
    {"psnr", true, 0, infinite, "dB", "peak signal-to-noise ratio, at least"},
    {"ssim", true, -1, 1, "", "SSIM (Wang 2004), at least"},
    {"bias_tile_max", false, 0, 1, "full scale",
     "largest |mean signed difference| of a tile of 16x16 pixels"},
    {"bias_mean", false, 0, 1, "full scale", "|mean signed difference| of the picture"},
    {"flicker_tile_max", false, 0, 2, "full scale",
     "largest change of a tile's mean signed difference from the frame before"},
    {"flicker_mean", false, 0, 2, "full scale", "the same of the whole picture"},
    {"mc_false_discovery", true, 0, 1, "",
     "least p-value of Welch's test of the light of 8x8 pixels, adjusted by Benjamini and Hochberg, at "
     "least"},
    {"mc_global_z", false, 0, infinite, "", "|z| of the whole picture's light"},
};

struct PresetRow {
  LimitName name;
  double value;
  std::optional<double> light_tested = {};
};
struct Preset {
  const char* name;
  std::vector<PresetRow> rows;
};

/// `render` passes what nobody sees: a step of 1 in 255, another anti-aliasing, the noise of 256 samples.
/// `mc` passes the noise of 16 samples, which averages out of a tile's signed mean, where a moved object or
/// another gamma does not. Of pictures with tile_statistics it tests the light itself: where all is noise a
/// frame fails by chance once in a thousand at most (by z once in a million), and as the variances are the
/// true ones or larger, far less. Then the limits on the picture's tiles are wider: at 2 samples against 64,
/// or on metal, noise alone breaks those that must do without the test.
const std::vector<Preset>& presets() {
  using enum LimitName;
  static const std::vector<Preset> all = {
      {"exact", {{max_abs, 0}}},
      {"lsb", {{max_abs, 1.0 / 255}}},
      {default_preset,
       {{flip_tile_max, render::GateLimits{}.flip_tile_max},
        {flip_mean, render::GateLimits{}.flip_mean},
        {flicker_tile_max, 0.02},
        {flicker_mean, 0.005}}},
      {"mc",
       {{flip_tile_max, 0.2, 0.5},
        {flip_mean, 0.1},
        {bias_tile_max, 0.028, 0.12},
        {bias_mean, 0.008},
        {flicker_mean, 0.008},
        {mc_false_discovery, 0.001},
        {mc_global_z, 5}}},
  };
  return all;
}

/// With as many digits as tell it from the limit.
std::string number_beside(double value, double limit) {
  int digits = 4;
  while (digits < 17 && fmt::format("{:.{}g}", value, digits) == fmt::format("{:.4g}", limit)) ++digits;
  return fmt::format("{:.{}g}", value, digits);
}

constexpr std::array channel_names = {"red", "green", "blue"};

class Judge {
public:
  explicit Judge(const Limits& limits, bool light_tested = false)
      : limits_(limits), light_tested_(light_tested) {}
  std::vector<CheckFailure> failures;

  void hold(LimitName name, double value, const std::string& place = "", const char* rule = nullptr) {
    const LimitValue& limit = limits_[name];
    if (!limit.value) return;
    const double bound = light_tested_ ? limit.light_tested.value_or(*limit.value) : *limit.value;
    const LimitRow& row = limit_row(name);
    if (row.least ? value >= bound : value <= bound) return;  // a NaN fails
    failures.push_back({rule != nullptr ? rule : row.name, number_beside(value, bound) + place,
                        fmt::format("{:.4g}", bound), limit.from});
  }

private:
  const Limits& limits_;
  bool light_tested_;
};

std::string place(const render::Tile& t) {
  return fmt::format(" at {},{} ({}x{} pixels)", t.x, t.y, t.width, t.height);
}

}  // namespace

const LimitRow& limit_row(LimitName name) { return rows[static_cast<std::size_t>(name)]; }
std::span<const LimitRow, limit_count> limit_rows() { return rows; }

std::vector<std::string> limit_names() {
  std::vector<std::string> names;
  for (const LimitRow& row : rows) names.emplace_back(row.name);
  return names;
}

std::vector<LimitTold> Limits::told() const {
  std::vector<LimitTold> all;
  for (std::size_t i = 0; i < limit_count; ++i) {
    if (values_[i].value) all.push_back({rows[i].name, *values_[i].value, rows[i].least, values_[i].from});
  }
  return all;
}

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const Preset& preset : presets()) names.emplace_back(preset.name);
  return names;
}

Limits preset_limits(const std::string& preset, const std::string& who) {
  Limits limits;
  for (const Preset& p : presets()) {
    if (preset != p.name) continue;
    for (const PresetRow& row : p.rows)
      limits[row.name] = {row.value, fmt::format("preset {} ({})", preset, who), row.light_tested};
  }
  return limits;
}

std::vector<CheckFailure> broken_limits(const FrameResult& frame, const Limits& limits) {
  using enum LimitName;
  Judge judge(limits, frame.light.has_value());
  const render::Figures& f = frame.figures.value();
  judge.hold(flip_tile_max, f.flip_tile.mean, place(f.flip_tile.tile));
  judge.hold(flip_mean, f.flip_mean);
  judge.hold(flip_max, f.flip_max);
  judge.hold(max_abs, f.differences.largest());
  judge.hold(mean_abs, f.differences.mean_absolute());
  judge.hold(rmse, f.differences.root_mean_square());
  judge.hold(pixels,
             3.0 * static_cast<double>(f.differences.pixels) / static_cast<double>(f.differences.samples));
  judge.hold(psnr, f.differences.psnr().value_or(infinite));
  if (f.ssim) judge.hold(ssim, *f.ssim);
  if (frame.bias) {
    judge.hold(bias_tile_max, frame.bias->tile.mean, place(frame.bias->tile.tile));
    judge.hold(bias_mean, frame.bias->mean);
  }
  if (frame.light) {
    const render::LightFigures& l = *frame.light;
    judge.hold(mc_false_discovery, l.false_discovery,
               fmt::format("{}, z {:.3g}, {} of {} tiles", place(l.cell), l.cell_z, l.discoveries, l.cells));
    judge.hold(mc_global_z, std::abs(l.global_z),
               fmt::format(", {} {} by {:.2g} %", channel_names[static_cast<std::size_t>(l.global_channel)],
                           l.global_change > 0 ? "brighter" : "darker", 100 * std::abs(l.global_change)));
  }
  if (f.alpha) {
    judge.hold(flip_tile_max, f.alpha->tile.mean, place(f.alpha->tile.tile), "alpha_tile_max");
    judge.hold(flip_mean, f.alpha->mean, "", "alpha_mean");
    judge.hold(max_abs, f.alpha->most, "", "alpha_max_abs");
  }
  return std::move(judge.failures);
}

std::vector<CheckFailure> broken_flicker_limits(const FrameResult& frame, const Limits& limits) {
  Judge judge(limits);
  if (frame.flicker) judge.hold(LimitName::flicker_tile_max, frame.flicker->mean, place(frame.flicker->tile));
  if (frame.flicker_mean) judge.hold(LimitName::flicker_mean, *frame.flicker_mean);
  return std::move(judge.failures);
}

}  // namespace lagomorph::apps
