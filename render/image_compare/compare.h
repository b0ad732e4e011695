#pragma once

#include <optional>

#include "render/image_compare/differences.h"
#include "render/image_compare/error_map.h"
#include "render/image_compare/flip_filters.h"
#include "render/image_compare/pooling.h"
#include "render/pixels.h"

namespace lagomorph::render {

/// Of |difference of alpha| in [0, 1].
struct AlphaFigures {
  double mean = 0;
  double most = 0;
  TileMean tile;
};

/// How two pictures of one size differ. Over R, G and B, but for `alpha`.
struct Figures {
  bool equal = true;  // every sample of R, G and B
  double flip_mean = 0;
  std::array<double, 3> flip_quartiles{};  // weighted
  double flip_min = 0;
  double flip_max = 0;
  TileMean flip_tile;  // the largest mean of a tile of 16x16 pixels
  Differences differences;
  std::optional<double> ssim = 1;     // nothing under 11 pixels of width or height
  std::optional<AlphaFigures> alpha;  // where one of them has alpha
};

struct Comparison {
  Figures figures;
  ErrorMap flip;  // empty when the pictures are equal
};

/// All figures of two pictures, 8-bit ones widened to 16 where the other has 16. Equal ones are found out
/// without any metric. The same bits for any number of threads. Throws SettingsError for pictures of
/// different sizes and for pixels per degree outside 1..1000.
Comparison compare_pictures(const Pixels& a, const Pixels& b,
                            double pixels_per_degree = default_pixels_per_degree);

/// What compare_pictures finds for two copies of a picture.
Figures figures_of_equals(int width, int height, bool alpha);

}  // namespace lagomorph::render
