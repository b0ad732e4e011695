#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "render/color.h"

namespace lagomorph::render {

/// The samples of a picture file as they are stored, expanded to RGB or RGBA; rows from the top, no gamma
/// applied.
struct Pixels {
  int width = 0;
  int height = 0;
  int channels = 3;    // of the file: 1 grey, 2 grey and alpha, 3 colour (or a palette), 4 colour and alpha
  bool alpha = false;  // 4 samples a pixel, otherwise 3
  /// 8 bits (1, 2 and 4 are scaled to 8) or 16; width*height*(3 or 4) of them.
  std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>> samples;

  int bit_depth() const { return samples.index() == 0 ? 8 : 16; }
  int samples_per_pixel() const { return alpha ? 4 : 3; }
  std::size_t pixel_count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

/// A picture that the program made.
inline Pixels to_pixels(Picture picture) {
  if (picture.alpha.empty())
    return {.width = picture.width, .height = picture.height, .samples = std::move(picture.rgb)};
  std::vector<std::uint8_t> rgba;
  rgba.reserve(4 * picture.alpha.size());
  for (std::size_t i = 0; i < picture.alpha.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) rgba.push_back(picture.rgb[3 * i + k]);
    rgba.push_back(picture.alpha[i]);
  }
  return {.width = picture.width,
          .height = picture.height,
          .channels = 4,
          .alpha = true,
          .samples = std::move(rgba)};
}

}  // namespace lagomorph::render
