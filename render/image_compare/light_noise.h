#pragma once

#include <cstdint>
#include <vector>

#include "render/image_compare/error_map.h"

/// Whether two path-traced pictures are of the same light but for their noise: the statistical test of
/// pictures with other seeds and sample counts.
namespace lagomorph::render {

/// The channel tile_statistics of a picture (render/channels.h): 8 values a cell of 8x8 pixels.
struct LightStatistics {
  int width = 0;  // of the picture [pixels]
  int height = 0;
  std::vector<float> values;

  int columns() const;
  int rows() const;
  /// A path a pixel has no variance: nothing can be tested. False too where a value is not finite.
  bool usable() const;
};

struct LightFigures {
  int cells = 0;               // compared
  double false_discovery = 1;  // the least p-value of a cell and channel, adjusted by Benjamini and Hochberg
  Tile cell;                   // the one with the least p-value
  double cell_z = 0;           // Welch's statistic there, > 0 where the second is brighter
  int discoveries = 0;         // cells with an adjusted p-value under `level`
  double global_z = 0;         // of the whole picture, of the channel where |z| is largest; the sign as above
  int global_channel = 0;      // 0 red, 1 green, 2 blue
  double global_change = 0;    // (second - first) / first of that channel's mean
};

/// Welch's test [Welch 1947] of each cell's R, G and B, and of their means over the picture. The figures of
/// cells are held together by the false discovery rate [Benjamini and Hochberg 1995]: where all differences
/// are noise, false_discovery < q with a probability of q at most. The variances are the true ones or larger
/// (see path/tile_statistics.h), so are the probabilities.
///
/// `mask` (a pixel each, row by row; empty: none) leaves out every cell with a pixel that is not 0. Both are
/// usable and of one size.
LightFigures compare_light(const LightStatistics& first, const LightStatistics& second,
                           const std::vector<std::uint8_t>& mask, double level);

}  // namespace lagomorph::render
