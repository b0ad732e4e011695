#pragma once

#include <string>
#include <string_view>

#include "render/image.h"

namespace lagomorph::render {

/// Numbers that a 16-bit PNG holds: ids from 0 to this less 2, so that none has its 0.
inline constexpr int most_png_number = 65535;

/// Whether a channel fits into a PNG: by the table of channels. Light and what is below 0 and beyond [-1, 1]
/// do not.
bool fits_png(std::string_view channel);

/// The bytes of a 16-bit PNG. Normals are 0.5 + 0.5 n, so that 0 is half; albedos sRGB, as its chunk says;
/// alpha is linear; depths are millimetres, 0 where nothing is, 65535 for 65.535 m and more; ids are 1 more
/// than they are, 0 of the ground and where nothing is; counts as they are. `compression` is libdeflate's
/// level, 0..12. Throws SettingsError for a channel that does not fit and a number that is too large. Safe to
/// call from many threads.
std::string encode_channel_png(const Channel&, int compression);

}  // namespace lagomorph::render
