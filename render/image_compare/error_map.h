#pragma once

#include <cstddef>
#include <vector>

namespace lagomorph::render {

/// A rectangle of a picture. [pixels]
struct Tile {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// One value in [0, 1] a pixel, rows from the top.
struct ErrorMap {
  int width = 0;
  int height = 0;
  std::vector<float> values;

  const float* row(int y) const {
    return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
};

}  // namespace lagomorph::render
