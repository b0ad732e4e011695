#include "render/image_compare/magma.h"

#include <algorithm>
#include <cmath>

#include "render/colormap_tables.h"

namespace lagomorph::render {

std::array<std::uint8_t, 3> magma(float value) {
  const float index = std::round(255.0F * std::clamp(value, 0.0F, 1.0F));
  const std::uint32_t color = magma_table[static_cast<std::size_t>(std::isnan(value) ? 0.0F : index)];
  const auto byte = [&](unsigned shift) { return static_cast<std::uint8_t>((color >> shift) & 0xFFU); };
  return {byte(16), byte(8), byte(0)};
}

Picture magma_picture(const ErrorMap& map) {
  Picture picture{map.width, map.height, {}};
  picture.rgb.reserve(3 * map.values.size());
  for (const float value : map.values) {
    const std::array<std::uint8_t, 3> color = magma(value);
    picture.rgb.insert(picture.rgb.end(), color.begin(), color.end());
  }
  return picture;
}

}  // namespace lagomorph::render
