#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lagomorph::render {

/// What is added to 8-bit values before they are rounded, of a width of `amount`: the R2 sequence, whose
/// neighbours are far apart [Roberts 2018, "The unreasonable effectiveness of quasirandom sequences"]. The
/// same for red, green and blue, so that grey stays grey, and in all frames.
struct Dither {
  float amount = 0.0F;
  std::size_t width = 1;  // of the picture
};

/// Pixels first .. last - 1 of a picture. `alpha`: of each pixel, that its colour is divided by; nullptr: 1.
struct ToneRange {
  const float* linear;
  const float* alpha;
  std::size_t first, last;
  float scale;
  Dither dither;
};

using MapTones = void (*)(const ToneRange&, std::uint8_t* rgb);

std::vector<std::string> tone_curve_names();
/// Throws SettingsError for an unknown curve, listing the names.
MapTones find_tone_curve(std::string_view name);

}  // namespace lagomorph::render
