#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "render/image.h"
#include "render/tone_rows.h"
#include "render/types.h"

namespace lagomorph::render {

/// 8-bit sRGB pixels, 3 a pixel, rows from the top: what a PNG holds.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
  std::vector<std::uint8_t> alpha = {};  // 1 a pixel, straight (rgb is not times it); none: opaque
};

/// The exact piecewise curve of IEC 61966-2-1, and its inverse. Values outside [0, 1] are clamped.
float srgb_from_linear(float linear);
float linear_from_srgb(float srgb);

/// "color" of the image, times 2^exposure, through the named tone curve and sRGB, rounded to 8 bits. NaN
/// becomes black. Where it is `transparent` the colour is times the channel "alpha", which the picture gets,
/// rounded to 8 bits, while its own colour is not times it. `dither`: colours are
/// moved before they are rounded, by up to half of so many 8-bit steps either way, a fixed pattern of pixels;
/// with 1 their mean over many pixels is exact, and black and white stay. Throws SettingsError for an unknown
/// curve (listing the names) or an image without colour.
Picture tone_map(const Image&, std::string_view curve, float exposure, bool transparent = false,
                 float dither = 0.0F);

}  // namespace lagomorph::render
