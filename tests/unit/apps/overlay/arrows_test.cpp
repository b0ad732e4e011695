#include "apps/overlay/arrows.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "apps/overlay/shapes.h"

namespace lagomorph::apps {
namespace arrows_test {

using render::Vec3;

constexpr Color red = {255, 0, 0};

View view(int width = 160, int height = 120) {
  render::CameraSettings s;
  s.position = {0.0F, 0.0F, 3.0F};
  s.look_at = {0.0F, 0.0F, 0.0F};
  render::Ground none;
  none.enabled = false;
  return {render::Camera(s, width, height), none};
}

render::Picture grey(int width = 160, int height = 120) {
  return {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height), 128)};
}

/// Pixels that are exactly of a colour, and the extent of all that changed.
struct Drawn {
  int exact = 0, left = 9999, right = -1, top = 9999, bottom = -1;
};
Drawn drawn(const render::Picture& picture, const Color& color) {
  Drawn d;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const std::uint8_t* p = &picture.rgb[static_cast<std::size_t>(3 * (y * picture.width + x))];
      if (p[0] == color[0] && p[1] == color[1] && p[2] == color[2]) ++d.exact;
      if (p[0] == 128 && p[1] == 128 && p[2] == 128) continue;
      d = {d.exact, std::min(d.left, x), std::max(d.right, x), std::min(d.top, y), std::max(d.bottom, y)};
    }
  }
  return d;
}

TEST(Shapes, DiscsAndPolygonsHaveTheirAreas) {
  render::Picture picture = grey();
  fill_disc(picture, {80.0, 60.0}, 20.0, red);
  EXPECT_NEAR(drawn(picture, red).exact, 3.1416 * 20 * 20, 130);
  for (const bool turned : {false, true}) {
    picture = grey();
    std::array<Point, 3> triangle = {{{10, 10}, {50, 10}, {10, 40}}};
    if (turned) std::swap(triangle[0], triangle[1]);
    fill_convex(picture, triangle, red);
    EXPECT_NEAR(drawn(picture, red).exact, 600, 70);
  }
  picture = grey();
  fill_disc(picture, {0.0, 0.0}, 30.0, red);  // over the corner
  fill_disc(picture, {900.0, 60.0}, 30.0, red);
  fill_convex(picture, std::array<Point, 3>{{{5, 5}, {9, 9}, {7, 7}}}, {0, 255, 0});  // on a line
  EXPECT_EQ(drawn(picture, {0, 255, 0}).exact, 0);
  EXPECT_LE(drawn(picture, red).right, 31);
}

TEST(Arrows, GoFromTailToTip) {
  render::Picture picture = grey();
  draw_arrows(picture, view(),
              {{.from = {-0.5F, 0.0F, 0.0F}, .to = {0.5F, 0.0F, 0.0F}, .color = red, .head = 0.3}});
  const Drawn d = drawn(picture, red);
  const render::Vec2 tail = view().camera().project({-0.5F, 0.0F, 0.0F}),
                     tip = view().camera().project({0.5F, 0.0F, 0.0F});
  const double pixels = 0.3 / static_cast<double>(view().camera().pixel_size(3.0F));  // of the head
  EXPECT_NEAR(d.left, tail.x() - 0.12 * pixels - 1.0, 1.5);                           // round, and its rim
  EXPECT_NEAR(d.right, tip.x() + 2.2, 1.5);
  EXPECT_GT(d.exact, 30);
  // Its width is the head's.
  EXPECT_NEAR(d.bottom - d.top, 0.78 * pixels, 5.0);
}

TEST(Arrows, AreFaintBehindThings) {
  const std::vector<Arrow> arrow = {
      {.from = {-0.5F, 0.0F, 0.0F}, .to = {0.5F, 0.0F, 0.0F}, .color = red, .head = 0.3}};
  View behind = view();
  const std::vector<Vec3> board = {{-9, -9, 1}, {9, -9, 1}, {0, 20, 1}};
  behind.items().draw(std::vector<render::Triangle>{{0, 1, 2}}, board);
  render::Picture picture = grey();
  draw_arrows(picture, behind, arrow);
  EXPECT_EQ(drawn(picture, red).exact, 0);
  EXPECT_GT(drawn(picture, red).right, 90);
  picture = grey();
  draw_arrows(picture, behind, arrow, false);
  EXPECT_GT(drawn(picture, red).exact, 30);
}

TEST(Arrows, OfNoLengthOrBehindTheCameraDrawNothing) {
  render::Picture picture = grey();
  draw_arrows(picture, view(),
              {{.from = Vec3::Zero(), .to = Vec3::Zero()},
               {.from = {0, 0, 4}, .to = {0, 0, 5}},
               {.from = {0, 0, 0}, .to = {0, 0, 1}}});
  draw_dots(picture, view().camera(), {{.at = {0, 0, 4}}});
  EXPECT_EQ(drawn(picture, red).right, -1);
}

/// A dot is as large in the world whatever the picture's size.
TEST(Dots, ScaleWithThePictureAndAreNeverTiny) {
  for (const int scale : {1, 2, 4}) {
    render::Picture picture = grey(160 * scale, 120 * scale);
    draw_dots(picture, view(160 * scale, 120 * scale).camera(),
              {{.at = Vec3::Zero(), .color = red, .diameter = 0.3}});
    const Drawn d = drawn(picture, red);
    const double diameter =
        0.3 / static_cast<double>(view(160 * scale, 120 * scale).camera().pixel_size(3.0F));
    EXPECT_NEAR(d.right - d.left + 1, diameter + 2.0, 2.0);
  }
  render::Picture picture = grey();
  draw_dots(picture, view().camera(), {{.at = Vec3::Zero(), .color = red, .diameter = 1e-6}});
  EXPECT_GT(drawn(picture, red).exact, 8);
}

}  // namespace arrows_test
}  // namespace lagomorph::apps
