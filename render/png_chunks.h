#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "render/error.h"

namespace lagomorph::render {

/// A picture file that cannot be read (exit status 2). One line: the file and what is wrong with it.
struct PictureError : SettingsError {
  using SettingsError::SettingsError;
};

/// What a PNG says of itself.
struct PngHeader {
  int width = 0;
  int height = 0;
  int bit_depth = 8;   // stored: 1, 2, 4, 8 or 16; of a palette's colours 8
  int channels = 3;    // after the palette: 1 grey, 2 grey and alpha, 3 colour, 4 colour and alpha
  bool alpha = false;  // by colour type or by a tRNS chunk
  bool interlaced = false;
};

/// The most pixels that are read: 16384 x 16384.
inline constexpr std::size_t most_png_pixels = std::size_t{1} << 28;

/// Walks the chunks of a PNG file (signature, lengths, CRCs, order of what matters) without decoding a pixel.
/// `name` is the file in the messages. Throws PictureError for what is no PNG, is truncated or damaged, is
/// too large, or claims more pixels than its compressed data can hold.
PngHeader read_png_header(std::string_view bytes, const std::string& name);

}  // namespace lagomorph::render
