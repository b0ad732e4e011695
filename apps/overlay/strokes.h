#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/color.h"

namespace lagomorph::apps {

/// A place in a picture [pixels], x to the right and y down from its upper left corner.
struct Point {
  double x = 0, y = 0;
};

struct Segment {
  Point a, b;
};

using Color = std::array<std::uint8_t, 3>;  // sRGB

/// One stroke with round ends and joints along segments, smoothed, as one layer: where segments cross it is
/// not darker. What lies outside is cut off. Width in pixels, at least 1. Opacity in [0, 1].
void draw_strokes(render::Picture&, std::span<const Segment>, double width, const Color&,
                  double opacity = 1.0);

}  // namespace lagomorph::apps
