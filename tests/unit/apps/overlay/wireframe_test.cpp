#include "apps/overlay/wireframe.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace wireframe_test {

using render::Triangle;
using render::Vec3;

render::Camera camera(const Vec3& position, bool orthographic = false) {
  render::CameraSettings s;
  s.position = position;
  s.look_at = {0.0F, 0.0F, 0.0F};
  s.fov = 40.0F;
  if (orthographic) s.orthographic = 3.0F;
  return {s, 160, 120};
}

render::Ground no_ground() {
  render::Ground ground;
  ground.enabled = false;
  return ground;
}

double length(const std::vector<Segment>& segments) {
  double sum = 0.0;
  for (const Segment& s : segments) sum += std::hypot(s.b.x - s.a.x, s.b.y - s.a.y);
  return sum;
}

/// The unit cube around the origin.
const std::vector<Vec3> corners = {{-0.5F, -0.5F, -0.5F}, {0.5F, -0.5F, -0.5F}, {0.5F, 0.5F, -0.5F},
                                   {-0.5F, 0.5F, -0.5F},  {-0.5F, -0.5F, 0.5F}, {0.5F, -0.5F, 0.5F},
                                   {0.5F, 0.5F, 0.5F},    {-0.5F, 0.5F, 0.5F}};
const std::vector<Triangle> faces = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                     {2, 3, 7}, {2, 7, 6}, {1, 2, 6}, {1, 6, 5}, {0, 4, 7}, {0, 7, 3}};

SeenLines lines_of_cube(const Vec3& eye, bool orthographic = false) {
  const LineMesh cube = line_mesh(faces);
  View view(camera(eye, orthographic), no_ground());
  view.items().draw(cube.triangles, corners);
  SeenLines lines;
  for (const auto& edge : cube.edges)
    view.add_line(corners[edge[0]], corners[edge[1]], triangles_at(cube, edge, 0), lines);
  return lines;
}

TEST(Wireframe, HasEachEdgeOnce) {
  EXPECT_EQ(line_mesh(faces).edges.size(), 18U);
  EXPECT_TRUE(line_mesh({}).edges.empty());
}

/// Of a cube seen onto a corner three faces are seen: nine edges and three diagonals, each whole.
TEST(Wireframe, SeenEdgesAreWholeAndTheOthersHidden) {
  for (const bool orthographic : {true, false}) {
    const SeenLines lines = lines_of_cube({2.0F, 1.7F, 2.5F}, orthographic);
    const auto long_ones = [](const std::vector<Segment>& all) {
      return std::count_if(all.begin(), all.end(), [](const Segment& s) { return length({s}) > 1.5; });
    };
    EXPECT_EQ(long_ones(lines.visible), 12) << orthographic;
    EXPECT_EQ(long_ones(lines.hidden), 6) << orthographic;
    // What is of the other kind are ends within a pixel of the silhouette.
    EXPECT_LT(length(lines.hidden) / length(lines.visible), 0.6);
  }
}

/// Faces at 2 degrees to the view, where depths change by many pixels' size from sample to sample.
TEST(Wireframe, HasNoGapsOnSteepFaces) {
  const float tilt = std::tan(2.0F * 3.14159265F / 180.0F);
  std::vector<Vec3> x;
  std::vector<Triangle> strip;
  for (std::uint32_t i = 0; i <= 12; ++i) {
    const float z = -3.0F + 0.5F * static_cast<float>(i);
    x.push_back({-0.8F, -tilt * z, z});
    x.push_back({0.8F, -tilt * z, z});
    if (i > 0) strip.insert(strip.end(), {{2 * i - 2, 2 * i - 1, 2 * i}, {2 * i - 1, 2 * i + 1, 2 * i}});
  }
  const LineMesh mesh = line_mesh(strip);
  View view(camera({0.0F, 0.0F, 6.0F}, true), no_ground());
  view.items().draw(mesh.triangles, x);
  SeenLines lines;
  for (const auto& edge : mesh.edges)
    view.add_line(x[edge[0]], x[edge[1]], triangles_at(mesh, edge, 0), lines);
  EXPECT_EQ(lines.visible.size(), mesh.edges.size());
  EXPECT_TRUE(lines.hidden.empty());
}

TEST(Wireframe, AnotherBodyHidesIt) {
  const LineMesh cube = line_mesh(faces);
  View view(camera({0.0F, 0.0F, 4.0F}), no_ground());
  // A board over the right half of the picture.
  const std::vector<Vec3> board = {{0, -9, 1}, {9, -9, 1}, {0, 9, 1}, {9, 9, 1}};
  view.items().draw(std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}, board, 100);
  SeenLines lines;
  view.add_line({-0.5F, 0.0F, 0.0F}, {0.5F, 0.0F, 0.0F}, {}, lines);
  ASSERT_EQ(lines.visible.size(), 1U);
  ASSERT_EQ(lines.hidden.size(), 1U);
  EXPECT_NEAR(lines.visible[0].b.x, 80.0, 0.5);
  EXPECT_NEAR(lines.hidden[0].a.x, 80.0, 0.5);
}

TEST(Wireframe, TheGroundHidesWhatIsBelowAndNotWhatStandsOnIt) {
  render::Ground ground;
  ground.height = -0.5F;
  const View view(camera({0.0F, 1.0F, 4.0F}), ground);
  EXPECT_TRUE(view.sees(Vec3(0.0F, -0.45F, 0.0F)));
  EXPECT_TRUE(view.sees(Vec3(0.0F, -0.5F, 0.0F)));
  EXPECT_FALSE(view.sees(Vec3(0.0F, -0.6F, 0.0F)));
  const View below(camera({0.0F, -1.0F, 4.0F}), ground);
  EXPECT_FALSE(below.sees(Vec3(0.0F, 1.0F, 0.0F)));
}

TEST(Wireframe, LinesBehindTheCameraAndOutsideAreLeftOut) {
  const View view(camera({0.0F, 0.0F, 4.0F}), no_ground());
  SeenLines lines;
  view.add_line({0.0F, 0.0F, 5.0F}, {0.0F, 1.0F, 6.0F}, {}, lines);
  view.add_line({90.0F, 0.0F, 0.0F}, {91.0F, 1.0F, 0.0F}, {}, lines);
  EXPECT_TRUE(lines.visible.empty());
  EXPECT_TRUE(lines.hidden.empty());
  view.add_line({0.1F, 0.0F, 0.0F}, {0.1F, 0.0F, 9.0F}, {}, lines);  // to behind the camera
  EXPECT_EQ(lines.visible.size(), 1U);
}

int drawn_pixels(const LineStyle& style) {
  render::Picture picture{160, 120, std::vector<std::uint8_t>(std::size_t{3} * 160 * 120, 255)};
  const LineMesh cube = line_mesh(faces);
  View view(camera({2.0F, 1.7F, 2.5F}), no_ground());
  view.items().draw(cube.triangles, corners);
  draw_wireframe(picture, view, cube, corners, 0, style);
  return static_cast<int>(
      std::count_if(picture.rgb.begin(), picture.rgb.end(), [](std::uint8_t v) { return v < 252; }));
}

TEST(Wireframe, StylesOfHiddenLines) {
  const int none = drawn_pixels({.hidden = "none"}), faint = drawn_pixels({.hidden = "faint"}),
            dashed = drawn_pixels({.hidden = "dashed"}), all = drawn_pixels({.hidden = "all"});
  EXPECT_GT(none, 100);
  EXPECT_GT(dashed, none + 50);
  EXPECT_GT(faint, dashed + 50);
  EXPECT_NEAR(all, faint, 0.1 * all);
  EXPECT_GT(drawn_pixels({.width = 3.0}), 1.5 * none);
  EXPECT_EQ(drawn_pixels({.opacity = 0.0}), 0);
}

}  // namespace wireframe_test
}  // namespace lagomorph::apps
