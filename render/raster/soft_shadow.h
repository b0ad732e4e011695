#pragma once

#include <span>
#include <vector>

#include "render/raster/depth_maps.h"
#include "render/raster/frame_block.h"
#include "render/raster/receivers.h"

namespace lagomorph::render::raster {

/// Part of a light that each receiver of each block sees. What a pixel and its eight neighbours find is
/// averaged, where they see the same surface to judge by their depths: weights of 1, 2 and 4 count all four
/// pixels of a quad alike, wherever it is, so that nothing is left of their different taps. Pixels within 2
/// of the border, or of a quad that is not wanted, lack neighbours. Of a light in parts each is found by
/// itself, and counts by what it gives. `hard`, one a block, gets those added that Shadow::hard tells of.
void soft_shadow(const FrameBlock&, const DepthMaps&, int light, const ReceiverBlocks&,
                 std::vector<Lanes>& seen, std::span<LaneBits> hard);

}  // namespace lagomorph::render::raster
