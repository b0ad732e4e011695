#pragma once

#include <nlohmann/json.hpp>

#include "render/image_compare/compare.h"

namespace lagomorph::apps {

/// The contract's figures by their names: flip_mean, flip_q1, flip_median, flip_q3, flip_max, flip_tile_max,
/// psnr (null when equal), ssim (null under 11 pixels), rmse, max_abs, equal.
nlohmann::ordered_json figures_json(const render::Figures&);

}  // namespace lagomorph::apps
