#include "apps/compare/figures_json.h"

#include <optional>

namespace lagomorph::apps {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

}  // namespace

Json figures_json(const render::Figures& figures) {
  return {{"flip_mean", figures.flip_mean},
          {"flip_q1", figures.flip_quartiles[0]},
          {"flip_median", figures.flip_quartiles[1]},
          {"flip_q3", figures.flip_quartiles[2]},
          {"flip_max", figures.flip_max},
          {"flip_tile_max", figures.flip_tile.mean},
          {"psnr", or_null(figures.differences.psnr())},
          {"ssim", or_null(figures.ssim)},
          {"rmse", figures.differences.root_mean_square()},
          {"max_abs", figures.differences.largest()},
          {"equal", figures.equal}};
}

}  // namespace lagomorph::apps
