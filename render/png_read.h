#pragma once

#include <string>
#include <string_view>

#include "render/pixels.h"
#include "render/png_chunks.h"

namespace lagomorph::render {

/// Decodes the bytes of a PNG file: any colour type, 1 to 16 bits, interlaced or not, transparency by alpha
/// or tRNS. Gamma and colour profiles are left alone. `name` is the file in the messages. Throws PictureError
/// for what is no whole PNG, before memory for its pixels is taken (see read_png_header).
Pixels read_png(std::string_view bytes, const std::string& name);

}  // namespace lagomorph::render
