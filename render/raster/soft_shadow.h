#pragma once

#include <vector>

#include "render/raster/depth_maps.h"
#include "render/raster/frame_block.h"
#include "render/raster/pixel_block.h"

namespace lagomorph::render::raster {

/// Receivers of a rectangle of pixels, rows of blocks from below.
struct ReceiverBlocks {
  int columns = 0, rows = 0;  // of blocks
  std::vector<Receivers> blocks;
  std::vector<char> empty;  // 1: nothing is in the block

  int width() const { return columns * block_width; }
  int height() const { return rows * block_height; }
  void resize(int block_columns, int block_rows);
};

/// Part of a light that each pixel sees, rows from below. What a pixel and its eight neighbours find is
/// averaged, where they see the same surface to judge by their depths: weights of 1, 2 and 4 count all four
/// pixels of a quad alike, wherever it is, so that nothing is left of their different taps. Pixels within 2
/// of the border lack neighbours.
void soft_shadow(const FrameBlock&, const DepthMaps&, int light, const ReceiverBlocks&,
                 std::vector<float>& seen);

}  // namespace lagomorph::render::raster
