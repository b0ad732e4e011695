#include "render/image_compare/differences.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/pictures.h"

namespace lagomorph::render {
namespace differences_test {

using tests::bytes_of;
using tests::grainy;

TEST(Differences, ByHand) {
  const Pixels a{.width = 2, .height = 1, .samples = std::vector<std::uint8_t>{10, 20, 30, 255, 0, 7}};
  const Pixels b{.width = 2, .height = 1, .samples = std::vector<std::uint8_t>{10, 20, 30, 0, 5, 7}};
  const Differences d = color_differences(a, b);
  EXPECT_EQ(d.samples, 6U);
  EXPECT_EQ(d.pixels, 1U);
  EXPECT_EQ(d.sum, 260U);
  EXPECT_EQ(d.square_sum, 65050U);
  EXPECT_EQ(d.most, 255U);
  EXPECT_DOUBLE_EQ(d.mean_absolute(), 260.0 / (6 * 255));
  EXPECT_DOUBLE_EQ(d.largest(), 1);
  EXPECT_DOUBLE_EQ(d.root_mean_square(), std::sqrt(65050.0 / 6) / 255);
  EXPECT_NEAR(d.psnr().value(), 10 * std::log10(255.0 * 255 * 6 / 65050), 1e-12);
}

TEST(Differences, EqualPicturesHaveNoPsnr) {
  const Differences d = color_differences(grainy(20, 10, 1), grainy(20, 10, 1));
  EXPECT_EQ(d.pixels, 0U);
  EXPECT_EQ(d.most, 0U);
  EXPECT_EQ(d.root_mean_square(), 0);
  EXPECT_FALSE(d.psnr().has_value());
}

TEST(Differences, BlackAndWhiteAreZeroDecibelsApart) {
  const Pixels black{.width = 700, .height = 500, .samples = std::vector<std::uint8_t>(1050000, 0)};
  const Pixels white{.width = 700, .height = 500, .samples = std::vector<std::uint8_t>(1050000, 255)};
  const Differences d = color_differences(black, white);
  EXPECT_EQ(d.sum, 255U * 1050000U);
  EXPECT_EQ(d.square_sum, 65025ULL * 1050000ULL);
  EXPECT_EQ(d.pixels, 350000U);
  EXPECT_EQ(d.psnr().value(), 0);
  EXPECT_FALSE(std::signbit(d.psnr().value()));
}

TEST(Differences, SixteenBitsDoNotOverflow) {
  const Pixels black{.width = 700, .height = 500, .samples = std::vector<std::uint16_t>(1050000, 0)};
  const Pixels white{.width = 700, .height = 500, .samples = std::vector<std::uint16_t>(1050000, 65535)};
  const Differences d = color_differences(black, white);
  EXPECT_EQ(d.square_sum, 4294836225ULL * 1050000ULL);
  EXPECT_EQ(d.root_mean_square(), 1);
  EXPECT_EQ(d.largest(), 1);
}

TEST(Differences, WidenedPicturesDifferAsMuch) {
  const Pixels a = grainy(61, 43, 1);
  const Pixels b = grainy(61, 43, 2);
  const Differences narrow = color_differences(a, b);
  const Differences wide = color_differences(widened(a), widened(b));
  EXPECT_EQ(wide.pixels, narrow.pixels);
  EXPECT_EQ(wide.sum, 257 * narrow.sum);
  EXPECT_NEAR(wide.root_mean_square(), narrow.root_mean_square(), 1e-15);
  EXPECT_NEAR(wide.mean_absolute(), narrow.mean_absolute(), 1e-15);
  EXPECT_EQ(wide.largest(), narrow.largest());
  EXPECT_EQ(widened(widened(a)).samples, widened(a).samples);
}

TEST(Differences, AlphaIsApart) {
  const Pixels opaque{.width = 2, .height = 1, .samples = std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6}};
  const Pixels clear{.width = 2,
                     .height = 1,
                     .channels = 4,
                     .alpha = true,
                     .samples = std::vector<std::uint8_t>{1, 2, 3, 255, 4, 5, 7, 51}};
  const Differences d = color_differences(opaque, clear);
  EXPECT_EQ(d.samples, 6U);
  EXPECT_EQ(d.pixels, 1U);
  EXPECT_EQ(d.sum, 1U);
  EXPECT_EQ(alpha_map(opaque, clear).values, (std::vector<float>{0.0F, 0.8F}));
  EXPECT_EQ(alpha_map(widened(clear), widened(opaque)).values, (std::vector<float>{0.0F, 0.8F}));
  EXPECT_EQ(alpha_map(clear, clear).values, (std::vector<float>{0.0F, 0.0F}));
}

}  // namespace differences_test
}  // namespace lagomorph::render
