#pragma once

#include <array>
#include <vector>

#include "render/image_compare/pooling.h"
#include "render/pixels.h"

namespace lagomorph::render {

/// Signed means of (b - a) over tiles of 16x16 pixels, of R, G and B each, in [-1, 1] of full scale. Noise of
/// either sign averages out of them; a cast, a missing or a moved object does not.
struct TileBias {
  int width = 0;  // of the pictures [pixels]
  int height = 0;
  std::vector<std::array<float, 3>> tiles;  // row by row; empty: all are 0

  int columns() const { return (width + tile_size - 1) / tile_size; }
  int rows() const { return (height + tile_size - 1) / tile_size; }
  /// Of tile i.
  Tile place(std::size_t i) const;
};

/// Of two pictures of one size and bit depth. Sums are of integers: the same bits for any number of threads.
TileBias tile_bias(const Pixels& a, const Pixels& b);

struct BiasFigures {
  double mean = 0;  // the largest |mean| of a channel over the picture
  TileMean tile;    // the largest |mean| of a channel over a tile
};
BiasFigures bias_figures(const TileBias&);

/// How the bias changes from one frame to the next: a difference that stays is none, one that comes and goes
/// is. Of two pairs of pictures of one size; no tiles where they are of different ones.
TileBias change_of_bias(const TileBias& before, const TileBias& now);

}  // namespace lagomorph::render
