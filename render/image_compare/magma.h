#pragma once

#include <array>
#include <cstdint>

#include "render/color.h"
#include "render/image_compare/error_map.h"

namespace lagomorph::render {

/// The sRGB colour of a value in [0, 1] in the colour map "magma": black, purple, orange, pale yellow. Values
/// outside are clamped.
std::array<std::uint8_t, 3> magma(float value);

/// A heat picture of a map.
Picture magma_picture(const ErrorMap&);

}  // namespace lagomorph::render
