#include "apps/preview/small_picture.h"

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace small_picture_test {

using Bytes = std::vector<std::uint8_t>;

TEST(SmallPicture, IsTheMeanInLinearLight) {
  // Black and white in equal parts are half the light: 188 in sRGB, not 128.
  const render::Picture board{2, 2, {0, 0, 0, 255, 255, 255, 255, 255, 255, 0, 0, 0}};
  EXPECT_EQ(resized(board, {1, 1}).rgb, (Bytes{188, 188, 188}));
  const render::Picture three{3, 1, {0, 0, 0, 255, 255, 255, 255, 255, 255}};
  // Of three in two, the middle one goes half to each: a third, and all of the light.
  EXPECT_EQ(resized(three, {2, 1}).rgb, (Bytes{156, 156, 156, 255, 255, 255}));
}

TEST(SmallPicture, KeepsSamplesAtTheSameSize) {
  render::Picture all{256, 1, {}};
  for (int i = 0; i < 256; ++i) all.rgb.insert(all.rgb.end(), 3, static_cast<std::uint8_t>(i));
  EXPECT_EQ(resized(all, {256, 1}).rgb, all.rgb);
  // And one colour stays that colour at any size.
  const render::Picture plain = filled({97, 61}, {1, 77, 254});
  EXPECT_EQ(resized(plain, {13, 7}).rgb, filled({13, 7}, {1, 77, 254}).rgb);
}

TEST(SmallPicture, FitsIntoABoxWithoutGrowing) {
  EXPECT_EQ(size_within({1920, 1080}, {640, 640}), (Size{640, 360}));
  EXPECT_EQ(size_within({1080, 1920}, {640, 640}), (Size{360, 640}));
  EXPECT_EQ(size_within({64, 48}, {640, 640}), (Size{64, 48}));
  EXPECT_EQ(size_within({16384, 1}, {640, 640}), (Size{640, 1}));
}

TEST(SmallPicture, LaysWhatIsTransparentOverWhite) {
  render::Pixels pixels{.width = 3, .height = 1, .channels = 4, .alpha = true, .samples = {}};
  pixels.samples = Bytes{10, 20, 30, 255, 0, 0, 0, 0, 0, 0, 0, 128};
  EXPECT_EQ(opaque_picture(pixels).rgb, (Bytes{10, 20, 30, 255, 255, 255, 127, 127, 127}));
  render::Pixels deep{.width = 1, .height = 1, .samples = {}};
  deep.samples = std::vector<std::uint16_t>{0, 32896, 65535};
  EXPECT_EQ(opaque_picture(deep).rgb, (Bytes{0, 128, 255}));
}

TEST(SmallPicture, IsCutAtTheCanvasEdge) {
  render::Picture canvas = filled({2, 2}, {0, 0, 0});
  put_picture(canvas, 1, -1, filled({3, 2}, {9, 9, 9}));
  EXPECT_EQ(canvas.rgb, (Bytes{0, 0, 0, 9, 9, 9, 0, 0, 0, 0, 0, 0}));
  put_picture(canvas, 5, 5, filled({3, 2}, {7, 7, 7}));
  EXPECT_EQ(canvas.rgb, (Bytes{0, 0, 0, 9, 9, 9, 0, 0, 0, 0, 0, 0}));
}

}  // namespace small_picture_test
}  // namespace lagomorph::apps
