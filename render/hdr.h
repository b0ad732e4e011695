#pragma once

#include <span>
#include <string>
#include <vector>

#include "render/types.h"

namespace lagomorph::render {

/// A picture of linear light, rows from the top.
struct HdrPicture {
  int width = 0;
  int height = 0;
  std::vector<Color> texels;
};

/// Reads a Radiance picture (.hdr, .pic): 32-bit RGBE, plain or run-length encoded, rows from the top and
/// columns from the left [Ward 1991, "Real Pixels"; Radiance's reference manual]. Its EXPOSURE is undone.
/// Throws SettingsError that says what is wrong where.
HdrPicture read_hdr(std::span<const unsigned char> bytes);
/// The same, run-length encoded where the width allows. Values above 0 keep 8 bits.
std::string write_hdr(const HdrPicture&);

}  // namespace lagomorph::render
