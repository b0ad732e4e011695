#include "apps/overlay/swatches.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/overlay/color_bar.h"
#include "apps/overlay/layout.h"
#include "render/colormap.h"

namespace lagomorph::apps {
namespace swatches_test {

render::Picture white(int width, int height) {
  return {
      width, height,
      std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 255)};
}

/// How many pixels have just this colour.
int count(const render::Picture& picture, const Color& color) {
  int n = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
    n += picture.rgb[i] == color[0] && picture.rgb[i + 1] == color[1] && picture.rgb[i + 2] == color[2];
  return n;
}

/// "body" of so many bodies in viridis.
ColorBar bodies(int n) {
  ColorBar bar{"body", "", &render::find_colormap("viridis"), 0.0, n > 1 ? n - 1.0 : 1.0};
  for (int i = 0; i < n; ++i)
    bar.categories.push_back({"bunny " + std::to_string(i), static_cast<double>(i)});
  return bar;
}

Color color_of_body(int i, int n) {
  const auto rgb =
      render::srgb_of(render::find_colormap("viridis"), static_cast<float>(i) / static_cast<float>(n - 1));
  Color color;
  for (std::size_t c = 0; c < 3; ++c) color[c] = static_cast<std::uint8_t>(std::lround(255.0F * rgb[c]));
  return color;
}

render::Picture drawn(int width, int height, const ColorBar& bar) {
  render::Picture picture = white(width, height);
  OverlayLayout layout(width, height);
  draw_color_bars(picture, {bar}, place_color_bars(layout, {bar}));
  return picture;
}

TEST(Swatches, ShowEachColorOnceInTheSameSize) {
  const render::Picture picture = drawn(640, 360, bodies(3));
  const int first = count(picture, color_of_body(0, 3));
  EXPECT_GT(first, 60);
  EXPECT_EQ(count(picture, color_of_body(1, 3)), first);
  EXPECT_EQ(count(picture, color_of_body(2, 3)), first);
  EXPECT_EQ(count(picture, color_of_body(1, 5)), 0) << "nothing in between";
}

TEST(Swatches, ABarTakesTheirPlaceWhereTheyHaveNoRoom) {
  ColorBar plain = bodies(40);
  plain.categories.clear();
  EXPECT_EQ(drawn(640, 360, bodies(40)).rgb, drawn(640, 360, plain).rgb);
  EXPECT_NE(drawn(640, 360, bodies(4)).rgb, drawn(640, 360, plain).rgb);
}

TEST(Swatches, LongNamesAreCut) {
  ColorBar bar = bodies(2);
  const double usual = color_bar_strip(640, 360, {bar});
  bar.categories[1].name = std::string(200, 'w');
  const double wide = color_bar_strip(640, 360, {bar});
  EXPECT_GT(wide, usual);
  EXPECT_LT(wide, 0.3);
  EXPECT_LT(color_bar_strip(160, 120, {bar}), 0.42) << "a small panel";
}

TEST(Swatches, GrowWithThePicture) {
  const Swatches small(640, 360, "body", {{"bar", {}}, {"bunny", {}}}),
      large(1280, 720, "body", {{"bar", {}}, {"bunny", {}}});
  EXPECT_GT(large.width(), 1.5 * small.width());
  EXPECT_GT(large.height(), 1.5 * small.height());
  EXPECT_TRUE(small.fits());
  EXPECT_FALSE(Swatches(64, 48, "body", {{"bar", {}}, {"bunny", {}}, {"cube", {}}}).fits());
}

}  // namespace swatches_test
}  // namespace lagomorph::apps
