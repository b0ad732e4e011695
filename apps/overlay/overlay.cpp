#include "apps/overlay/overlay.h"

#include <algorithm>
#include <cmath>

namespace lagomorph::apps {
namespace {

constexpr Color plate_color = {18, 20, 24};
constexpr double plate_opacity = 0.68;

/// How much of the pixel from `at` on lies in [low, high].
double covered(int at, double low, double high) {
  return std::clamp(std::min(at + 1.0, high) - std::max(static_cast<double>(at), low), 0.0, 1.0);
}

int pixel_at(double place, int most) {
  return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(most)));
}

}  // namespace

double overlay_unit(int width, int height) { return 0.01 * std::min(width, height); }

double overlay_text_height(int width, int height) { return std::max(6.0, 1.7 * overlay_unit(width, height)); }

void blend(render::Picture& picture, int x, int y, const Color& color, double opacity) {
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                              static_cast<std::size_t>(x));
  for (std::size_t i = 0; i < 3; ++i) {
    std::uint8_t& value = picture.rgb[at + i];
    value = static_cast<std::uint8_t>(std::lround(value + opacity * (color[i] - value)));
  }
}

void fill_rectangle(render::Picture& picture, const Rectangle& r, const Color& color, double opacity) {
  const int x0 = pixel_at(std::floor(r.left), picture.width),
            x1 = pixel_at(std::ceil(r.right), picture.width);
  const int y0 = pixel_at(std::floor(r.top), picture.height),
            y1 = pixel_at(std::ceil(r.bottom), picture.height);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      blend(picture, x, y, color, opacity * covered(x, r.left, r.right) * covered(y, r.top, r.bottom));
    }
  }
}

void draw_plate(render::Picture& picture, const Rectangle& r) {
  fill_rectangle(picture, r, plate_color, plate_opacity);
}

}  // namespace lagomorph::apps
