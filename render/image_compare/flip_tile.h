#pragma once

#include <vector>

#include "render/image_compare/error_map.h"
#include "render/image_compare/flip_filters.h"
#include "render/image_compare/lanes.h"
#include "render/image_compare/linear_pair.h"

namespace lagomorph::render {

/// FLIP of one tile of a pair into out[y * out_stride + x], rows of the tile from 0. Every value is a
/// function of the pixels around it alone, whatever the tile and the instruction set.
/// `scratch` is memory that tiles of one thread use again and again.
void flip_tile(const LinearPair&, const FlipFilters&, const Tile&, InstructionSet,
               std::vector<float>& scratch, float* out, std::size_t out_stride);

}  // namespace lagomorph::render
