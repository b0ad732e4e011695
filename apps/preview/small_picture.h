#pragma once

#include <array>
#include <cstdint>

#include "render/color.h"
#include "render/pixels.h"

namespace lagomorph::apps {

struct Size {
  int width = 0;
  int height = 0;
  bool operator==(const Size&) const = default;
};

/// A picture's samples as 8-bit RGB; what is transparent lies over white, blended in sRGB as browsers do.
render::Picture opaque_picture(const render::Pixels&);

/// The largest size of the same proportions within `box`; never larger than `of`, no side under 1.
Size size_within(Size of, Size box);

/// A picture made smaller: each pixel is the mean of the area it covers, in linear light. The same size gives
/// the same samples. `to` must not be larger than the picture on either side.
render::Picture resized(const render::Picture&, Size to);

/// `picture` over `canvas`, its upper left corner at x, y; what lies outside is cut off.
void put_picture(render::Picture& canvas, int x, int y, const render::Picture& picture);

/// A canvas of one colour.
render::Picture filled(Size, const std::array<std::uint8_t, 3>& color);

}  // namespace lagomorph::apps
