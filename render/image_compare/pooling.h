#pragma once

#include <array>

#include "render/image_compare/error_map.h"

/// One figure of many, in double and in a fixed order: the same bits for any number of threads.
namespace lagomorph::render {

double mean(const ErrorMap&);

struct Range {
  double least = 0;
  double most = 0;
};
Range range(const ErrorMap&);

/// For q = 1/4, 1/2, 3/4 the value at which the running sum of the values in ascending order first exceeds q
/// times the total; 0 for a map of zeros [Andersson 2020, Sec. 5]. Found by their bits, without sorting.
std::array<double, 3> weighted_quartiles(const ErrorMap&);

/// Tiles are squares of so many pixels from the map's corner on; those at the border average what they have.
inline constexpr int tile_size = 16;
struct TileMean {
  Tile tile;
  double mean = 0;
};
/// The largest mean of a tile; of equals the first, row by row.
TileMean largest_tile_mean(const ErrorMap&);

}  // namespace lagomorph::render
