#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "render/channels.h"
#include "render/path/path_tracer.h"
#include "render/types.h"

namespace lagomorph::render::path {

/// Mean radiance of cells of 8x8 pixels and the variance of that mean, of one traced tile.
///
/// Samples of a low-discrepancy sequence are not independent: the variance between single samples would make
/// the mean's variance many times too large. So the samples of every pixel are cut into at most 16 batches of
/// consecutive ones, small nets themselves, each of which has that mean; the variance between the means of
/// the batches over their number would be that of the mean if they were independent. The batches of one
/// scrambled net keep apart instead [Owen 1997]: the variance told is the true one or larger (7 times at 64
/// samples, in the median of the bunny's cells), so that what is held against it is seldom blamed wrongly.
class TileStatistics {
public:
  /// Cells begin at the picture's corner; so must the tile, at a multiple of statistics_cell.
  TileStatistics(const Tile&, int samples);

  /// A pixel's sample. Sums go in the order of the calls.
  void add(int x, int y, int sample, const Color& radiance);
  /// The cells' values into the channel of a picture of this width: see statistics_channel.
  void write(int picture_width, float* channel) const;

private:
  static constexpr int most_batches = 16;

  Tile tile_;
  int samples_;
  int batches_;
  int columns_;
  std::vector<Eigen::Array3d> sums_;  // [cell][batch]
  std::vector<int> counts_;           // of samples, likewise
};

}  // namespace lagomorph::render::path
