#include "apps/compare/compare_floats.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/cli/print.h"
#include "apps/compare/heat_file.h"
#include "apps/compare/verdict.h"
#include "apps/file_io.h"
#include "apps/npy.h"
#include "render/image_compare/gate.h"

namespace lagomorph::apps {
namespace {

using Json = nlohmann::ordered_json;

struct FloatFigures {
  double rmse = 0;
  double max_abs = 0;
  std::size_t pixels = 0;  // that differ
};

FloatFigures differences(const render::FloatPicture& a, const render::FloatPicture& b) {
  FloatFigures figures;
  double squares = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
    bool differs = false;
    for (std::size_t k = i; k < i + 3; ++k) {
      differs |= a.rgb[k] != b.rgb[k] && !(std::isnan(a.rgb[k]) && std::isnan(b.rgb[k]));
      if (!std::isfinite(a.rgb[k]) || !std::isfinite(b.rgb[k])) continue;
      const double off = std::abs(static_cast<double>(a.rgb[k]) - b.rgb[k]);
      squares += off * off;
      figures.max_abs = std::max(figures.max_abs, off);
      ++count;
    }
    figures.pixels += differs ? 1 : 0;
  }
  if (count > 0) figures.rmse = std::sqrt(squares / static_cast<double>(count));
  return figures;
}

}  // namespace

bool is_float_channel(const std::string& file) { return file.ends_with(".npy"); }

render::FloatPicture read_float_picture(const std::string& file) {
  const NpyFloats array = read_npy_floats(read_file(file), file);
  const std::vector<std::size_t>& shape = array.shape;
  constexpr std::size_t most = 16384;
  const bool grey = shape.size() == 2 || (shape.size() == 3 && shape[2] == 1);
  const bool color = shape.size() == 3 && shape[2] == 3;
  if ((!grey && !color) || shape[0] < 1 || shape[1] < 1 || shape[0] > most || shape[1] > most) {
    wrong_input(fmt::format("{}: has the shape {}; (H, W) or (H, W, 3) with up to {} each way would be right",
                            file, shape_text(shape), most));
  }
  render::FloatPicture picture{static_cast<int>(shape[1]), static_cast<int>(shape[0]), {}};
  if (color) {
    picture.rgb = array.values;
  } else {
    for (const float v : array.values) picture.rgb.insert(picture.rgb.end(), {v, v, v});
  }
  return picture;
}

ExitStatus compare_floats(const Options& options) {
  const std::string &a = options.inputs.at(0), &b = options.inputs.at(1);
  const render::FloatPicture first = read_float_picture(a), second = read_float_picture(b);
  const double ppd = options.pixels_per_degree.value_or(render::default_pixels_per_degree);
  if (first.width != second.width || first.height != second.height) {
    PairVerdict verdict;
    verdict.failures = render::gate_kinds({.width = first.width, .height = first.height},
                                          {.width = second.width, .height = second.height});
    if (options.json) {
      print(verdict_json(verdict));
    } else if (!options.quiet) {
      print(verdict_text(verdict, a, b, ppd));
    }
    return ExitStatus::different;
  }
  const FloatFigures plain = differences(first, second);
  const render::HdrFlip flip = render::hdr_flip(first, second, ppd);
  render::Figures figures;
  figures.equal = plain.pixels == 0;
  figures.flip_mean = render::mean(flip.map);
  figures.flip_quartiles = render::weighted_quartiles(flip.map);
  figures.flip_max = render::range(flip.map).most;
  figures.flip_tile = render::largest_tile_mean(flip.map);
  const auto failures = render::gate_figures(figures);
  if (options.heat) write_heat_map(*options.heat, flip.map);
  if (options.out) write_heat_map(*options.out / "heat.png", flip.map);
  const auto& q = figures.flip_quartiles;
  if (options.json) {
    const Json json = {{"same", failures.empty()},
                       {"flip_mean", figures.flip_mean},
                       {"flip_q1", q[0]},
                       {"flip_median", q[1]},
                       {"flip_q3", q[2]},
                       {"flip_max", figures.flip_max},
                       {"flip_tile_max", figures.flip_tile.mean},
                       {"psnr", nullptr},
                       {"ssim", nullptr},
                       {"rmse", plain.rmse},
                       {"max_abs", plain.max_abs},
                       {"equal", figures.equal},
                       {"exposures", {flip.exposures.start, flip.exposures.stop, flip.exposures.count}}};
    print(json.dump() + "\n");
  } else if (!options.quiet) {
    const char* verdict = figures.equal      ? "equal"
                          : failures.empty() ? "the same by the default limits"
                                             : "different";
    std::string text = fmt::format("{} and {}: {}\n", a, b, verdict);
    for (const render::GateFailure& failure : failures)
      text += fmt::format("  {:<14}{}\n", "fails by", failure.line());
    text += fmt::format("  {:<14}mean {:.6f}, weighted quartiles {:.6f} {:.6f} {:.6f}, largest {:.6f}\n",
                        "HDR-FLIP", figures.flip_mean, q[0], q[1], q[2], figures.flip_max);
    text +=
        fmt::format("  {:<14}largest mean of a tile {:.6f}; {} exposures from {:.3f} to {:.3f} stops\n", "",
                    figures.flip_tile.mean, flip.exposures.count, flip.exposures.start, flip.exposures.stop);
    text += fmt::format("  {:<14}{} pixels, the largest {:.6g}, RMSE {:.6g}\n", "differences", plain.pixels,
                        plain.max_abs, plain.rmse);
    print(text);
  }
  return failures.empty() ? ExitStatus::done : ExitStatus::different;
}

}  // namespace lagomorph::apps
