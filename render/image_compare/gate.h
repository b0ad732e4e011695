#pragma once

#include <string>
#include <vector>

#include "render/image_compare/compare.h"
#include "render/pixels.h"
#include "render/png_chunks.h"

namespace lagomorph::render {

/// What two pictures that are the same may differ by at most. The defaults pass what nobody sees (a step of 1
/// in 255, another anti-aliasing of an edge, the noise of 256 samples) and fail what one looks for (an object
/// that is missing or moved, a cast, another gamma).
struct GateLimits {
  double flip_tile_max = 0.12;  // also of alpha's differences
  double flip_mean = 0.05;      // likewise
};

/// What a picture file is, before its pixels.
struct PictureKind {
  int width = 0;
  int height = 0;
  int bit_depth = 8;  // 8 or 16
  int channels = 3;   // 1 grey, 2 grey and alpha, 3 colour, 4 colour and alpha
};
PictureKind kind_of(const Pixels&);
PictureKind kind_of(const PngHeader&);

/// A rule that a pair breaks: what was found, what is allowed.
struct GateFailure {
  std::string rule;   // "size", "bit_depth", "channels", "flip_tile_max", "flip_mean", "alpha_tile_max", ...
  std::string found;  // "0.2222 at 192,96 (16x16 pixels)"
  std::string limit;  // "0.12"; empty where the two have to be the same
  /// "flip_tile_max 0.2222 at 192,96 (16x16 pixels), limit 0.12"
  std::string line() const;
};

/// Rules that the kinds alone break.
std::vector<GateFailure> gate_kinds(const PictureKind& a, const PictureKind& b);
/// Rules that the figures break. A pair is the same when no rule is broken.
std::vector<GateFailure> gate_figures(const Figures&, const GateLimits& = {});

}  // namespace lagomorph::render
