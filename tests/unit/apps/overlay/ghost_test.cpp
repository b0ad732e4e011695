#include "apps/overlay/ghost.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace ghost_test {

using render::Triangle;
using render::Vec3;

const std::vector<Vec3> corners = {{-0.5F, -0.5F, -0.5F}, {0.5F, -0.5F, -0.5F}, {0.5F, 0.5F, -0.5F},
                                   {-0.5F, 0.5F, -0.5F},  {-0.5F, -0.5F, 0.5F}, {0.5F, -0.5F, 0.5F},
                                   {0.5F, 0.5F, 0.5F},    {-0.5F, 0.5F, 0.5F}};
const std::vector<Triangle> cube = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                    {2, 3, 7}, {2, 7, 6}, {1, 2, 6}, {1, 6, 5}, {0, 4, 7}, {0, 7, 3}};

View view() {
  render::CameraSettings s;
  s.position = {2.0F, 1.7F, 2.5F};
  s.look_at = {0.0F, 0.0F, 0.0F};
  render::Ground none;
  none.enabled = false;
  return {render::Camera(s, 120, 90), none};
}

render::Picture white() { return {120, 90, std::vector<std::uint8_t>(std::size_t{3} * 120 * 90, 255)}; }

int changed(const render::Picture& picture) {
  return static_cast<int>(
      std::count_if(picture.rgb.begin(), picture.rgb.end(), [](std::uint8_t v) { return v != 255; }));
}

int drawn(const View& things, const GhostStyle& style) {
  render::Picture picture = white();
  draw_ghost(picture, things, line_mesh(cube), corners, style);
  return changed(picture);
}

/// Of a cube all twelve edges are sharp, and the diagonals of its faces are none of its contours.
TEST(Ghost, ContoursAreSharpEdgesAndSilhouettes) {
  const LineMesh mesh = line_mesh(cube);
  EXPECT_EQ(contours(mesh, corners, view().camera()).size(), 12U);
  // Of one triangle the border.
  EXPECT_EQ(contours(line_mesh({{0, 1, 2}}), corners, view().camera()).size(), 3U);
}

TEST(Ghost, FillIsTheSameForAnyOrderOfTriangles) {
  const GhostStyle style{.outline = false, .opacity = 0.5};
  render::Picture a = white(), b = white();
  draw_ghost(a, view(), line_mesh(cube), corners, style);
  std::vector<Triangle> backwards(cube.rbegin(), cube.rend());
  draw_ghost(b, view(), line_mesh(backwards), corners, style);
  EXPECT_EQ(a.rgb, b.rgb);
  EXPECT_GT(changed(a), 3000);
  // One layer: nowhere darker than half.
  EXPECT_GE(*std::min_element(a.rgb.begin(), a.rgb.end()), 127);
}

TEST(Ghost, ThingsHideItUnlessItIsOver) {
  View things = view();
  const int alone = drawn(things, {});
  // A board before all of it.
  const std::vector<Vec3> board = {{-9, -9, 1}, {9, -9, 1}, {0, 20, 1}};
  things.items().draw(std::vector<Triangle>{{0, 1, 2}}, board);
  EXPECT_EQ(drawn(things, {}), 0);
  EXPECT_EQ(drawn(things, {.over = true}), alone);
}

/// A body at rest is where its ghost is.
TEST(Ghost, FillIsNotSeenOnItself) {
  View things = view();
  things.items().draw(cube, corners);
  EXPECT_EQ(drawn(things, {.outline = false}), 0);
}

/// A thing so small that it is taken for a fold of the surface.
TEST(Ghost, OutlineHasNoCrumbs) {
  std::vector<Triangle> both = cube;
  std::vector<Vec3> x = corners;
  const auto add_triangle = [&](float size) {
    const auto first = static_cast<std::uint32_t>(x.size());
    both.push_back({first, first + 1, first + 2});
    for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(size, 0, 0), Vec3(0, size, 0)})
      x.push_back(corner + Vec3(-0.2F, -0.2F, 0.7F));
  };
  const auto outline = [&] {
    render::Picture picture = white();
    draw_ghost(picture, view(), line_mesh(both), x, {.fill = false});
    return picture.rgb;
  };
  const auto alone = outline();
  add_triangle(0.02F);
  EXPECT_EQ(outline(), alone);
  add_triangle(0.3F);
  EXPECT_NE(outline(), alone);
}

TEST(Ghost, OutlineOrFill) {
  const int fill = drawn(view(), {.outline = false}), outline = drawn(view(), {.fill = false});
  EXPECT_GT(outline, 300);
  EXPECT_GT(fill, 2 * outline);
}

}  // namespace ghost_test
}  // namespace lagomorph::apps
