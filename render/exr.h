#pragma once

#include <optional>
#include <span>
#include <string>

#include "render/image.h"

namespace lagomorph::render {

/// A part of a picture: the pixel of its top left corner, and the size of the whole.
struct PartOfPicture {
  int x = 0, y = 0;
  int width = 0, height = 0;
};

/// What a file says beside the values.
struct ExrHeader {
  std::optional<PartOfPicture> part = {};
  std::optional<double> fps = {};  // of the sequence that the frame is of [1/s]: framesPerSecond, a rational
};

/// The bytes of a scan-line OpenEXR file of 32-bit floats, ZIP-compressed, by the OpenEXR library. Channels
/// are named by the table of channels (channels.h): R, G, B; Z; normal.X, normal.Y, normal.Z; ... Light is
/// linear with Rec. 709 primaries. The same values give the same bytes. Safe to call from many threads.
/// Of a part the display window is that of the whole picture, the data window the part's.
std::string encode_exr(const Channel&, const ExrHeader& = {});

/// All in one file: the picture as R, G, B and A, which is 1 everywhere unless the picture is `transparent`,
/// when the colour is times it already (associated alpha); then those of `channels` that are of the picture's
/// size. The image must have them; "color" is the picture itself.
std::string encode_multilayer_exr(const Image&, std::span<const std::string> channels, bool transparent,
                                  const ExrHeader& = {});

}  // namespace lagomorph::render
