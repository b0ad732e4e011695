#pragma once

#include <bit>
#include <cstdint>

#include "render/simd.h"

namespace lagomorph::render::raster {

/// A half float that is neither negative nor infinite.
LAGOMORPH_INLINE float from_half(std::uint16_t half) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(half) << 13U) * 0x1p112F;
}

}  // namespace lagomorph::render::raster
