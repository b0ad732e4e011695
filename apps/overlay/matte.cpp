#include "apps/overlay/matte.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lagomorph::apps {
namespace {

using render::Picture;

/// Without alpha, over grey of this value.
Picture laid_over(const Picture& picture, double value) {
  Picture opaque{picture.width, picture.height, picture.rgb};
  for (std::size_t i = 0; i < opaque.rgb.size(); ++i) {
    const double alpha = picture.alpha[i / 3] / 255.0;
    opaque.rgb[i] = static_cast<std::uint8_t>(std::lround(alpha * picture.rgb[i] + (1.0 - alpha) * value));
  }
  return opaque;
}

}  // namespace

void overlay(Picture& picture, const std::function<void(Picture&)>& draw) {
  if (picture.alpha.empty()) {
    draw(picture);
    return;
  }
  const Picture black = laid_over(picture, 0.0), white = laid_over(picture, 255.0);
  Picture on_black = black, on_white = white;
  draw(on_black);
  draw(on_white);
  for (std::size_t pixel = 0; pixel < picture.alpha.size(); ++pixel) {
    const std::size_t at = 3 * pixel;
    const auto same = [&](const Picture& a, const Picture& b) {
      return std::equal(a.rgb.begin() + static_cast<std::ptrdiff_t>(at),
                        a.rgb.begin() + static_cast<std::ptrdiff_t>(at) + 3,
                        b.rgb.begin() + static_cast<std::ptrdiff_t>(at));
    };
    if (same(black, on_black) && same(white, on_white)) continue;
    double through = 0.0;  // of what is behind
    for (std::size_t k = at; k < at + 3; ++k) through += (on_white.rgb[k] - on_black.rgb[k]) / (3.0 * 255.0);
    const double alpha = std::clamp(1.0 - through, 0.0, 1.0);
    picture.alpha[pixel] = static_cast<std::uint8_t>(std::lround(255.0 * alpha));
    for (std::size_t k = at; k < at + 3; ++k) {
      const double value = alpha > 0.0 ? on_black.rgb[k] / alpha : 0.0;
      picture.rgb[k] = static_cast<std::uint8_t>(std::lround(std::min(value, 255.0)));
    }
  }
}

}  // namespace lagomorph::apps
