#include "apps/overlay/matte.h"

#include <cmath>

#include <gtest/gtest.h>

#include "apps/overlay/overlay.h"

namespace lagomorph::apps {
namespace matte_test {

using render::Picture;

/// One row: clear, half covered by red, opaque green.
Picture row() { return {3, 1, {0, 0, 0, 200, 0, 0, 0, 100, 0}, {0, 128, 255}}; }

TEST(Overlay, OfAnOpaquePictureIsWhatIsDrawn) {
  Picture picture{2, 1, {1, 2, 3, 4, 5, 6}};
  overlay(picture, [](Picture& on) { on.rgb[4] = 99; });
  EXPECT_EQ(picture.rgb, (std::vector<std::uint8_t>{1, 2, 3, 4, 99, 6}));
  EXPECT_TRUE(picture.alpha.empty());
}

TEST(Overlay, PixelsThatAreNotDrawnOnStayAsTheyAre) {
  Picture picture = row();
  overlay(picture, [](Picture& on) { fill_rectangle(on, {0, 0, 1, 1}, {50, 60, 70}, 1.0); });
  EXPECT_EQ(picture.alpha, (std::vector<std::uint8_t>{255, 128, 255}));
  EXPECT_EQ(picture.rgb, (std::vector<std::uint8_t>{50, 60, 70, 200, 0, 0, 0, 100, 0}));
}

TEST(Overlay, IsOverWhatIsThere) {
  Picture picture = row();
  constexpr double opacity = 0.6;
  overlay(picture, [](Picture& on) { fill_rectangle(on, {0, 0, 3, 1}, {50, 60, 70}, opacity); });
  const Picture before = row();
  for (std::size_t i = 0; i < 3; ++i) {
    // Porter and Duff's over.
    const double under = before.alpha[i] / 255.0, alpha = opacity + (1 - opacity) * under;
    EXPECT_NEAR(picture.alpha[i] / 255.0, alpha, 0.01) << i;
    for (std::size_t k = 0; k < 3; ++k) {
      const double color = std::array{50.0, 60.0, 70.0}[k];
      EXPECT_NEAR(picture.rgb[3 * i + k],
                  (opacity * color + (1 - opacity) * under * before.rgb[3 * i + k]) / alpha, 2.5)
          << i << " " << k;
    }
  }
}

}  // namespace matte_test
}  // namespace lagomorph::apps
