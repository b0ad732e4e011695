#pragma once

#include <array>
#include <cstdint>

namespace lagomorph::render {

/// A colour map in 256 even steps, sRGB as 0xRRGGBB, rounded to 8 bits.
using ColorTable = std::array<std::uint32_t, 256>;

extern const ColorTable viridis_table, magma_table, plasma_table, inferno_table, cividis_table,
    coolwarm_table;

}  // namespace lagomorph::render
