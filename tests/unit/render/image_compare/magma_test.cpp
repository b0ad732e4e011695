#include "render/image_compare/magma.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lagomorph::render {
namespace magma_test {

using Rgb = std::array<std::uint8_t, 3>;

/// Luma of sRGB codes.
int luma(const Rgb& c) { return 2126 * c[0] + 7152 * c[1] + 722 * c[2]; }

TEST(Magma, Ends) {
  EXPECT_EQ(magma(0.0F), (Rgb{0, 0, 4}));
  EXPECT_EQ(magma(1.0F), (Rgb{252, 253, 191}));
}

TEST(Magma, IsClamped) {
  EXPECT_EQ(magma(-1.0F), magma(0.0F));
  EXPECT_EQ(magma(2.0F), magma(1.0F));
  EXPECT_EQ(magma(std::nanf("")), magma(0.0F));
}

TEST(Magma, GetsBrighterInSmallSteps) {
  const auto color = [](int i) { return magma(static_cast<float>(i) / 255.0F); };
  for (int i = 1; i < 256; ++i) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_LE(std::abs(color(i)[c] - color(i - 1)[c]), 3) << i;
  }
  for (int i = 8; i < 256; ++i) EXPECT_GT(luma(color(i)), luma(color(i - 8))) << i;
}

TEST(Magma, PictureOfAMap) {
  const Picture picture = magma_picture({2, 1, {0.0F, 1.0F}});
  EXPECT_EQ(picture.width, 2);
  EXPECT_EQ(picture.height, 1);
  EXPECT_EQ(picture.rgb, (std::vector<std::uint8_t>{0, 0, 4, 252, 253, 191}));
}

}  // namespace magma_test
}  // namespace lagomorph::render
