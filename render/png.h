#pragma once

#include <string>

#include "render/color.h"

namespace lagomorph::render {

/// The bytes of an 8-bit RGB or, of a picture with alpha, RGBA PNG with an sRGB colour, by stb_image_write
/// with its compressor replaced by libdeflate. `compression` is libdeflate's level, 0..12. Safe to call from
/// many threads.
std::string encode_png(const Picture&, int compression);

}  // namespace lagomorph::render
