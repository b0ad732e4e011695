#include "apps/overlay/item_buffer.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace item_buffer_test {

using render::Triangle;
using render::Vec3;

/// Looks from z = 3 along -z at the square [-1, 1]^2 of the plane z = 0, which fills it.
render::Camera camera(bool orthographic) {
  render::CameraSettings s;
  s.position = {0.0F, 0.0F, 3.0F};
  s.look_at = {0.0F, 0.0F, 0.0F};
  s.fov = 2.0F * std::atan(1.0F / 3.0F) * 180.0F / 3.14159265F;
  if (orthographic) s.orthographic = 2.0F;
  return {s, 40, 40};
}

TEST(ItemBuffer, TheNearerIsSeenAndOfEqualOnesTheLast) {
  for (const bool orthographic : {true, false}) {
    ItemBuffer buffer(camera(orthographic));
    EXPECT_EQ(buffer.columns(), 80);
    EXPECT_EQ(buffer.item(40, 40), ItemBuffer::none);
    EXPECT_EQ(buffer.depth(40, 40), INFINITY);
    const std::vector<Triangle> two = {{0, 1, 2}, {3, 4, 5}};
    const std::vector<Vec3> x = {{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}, {-9, -9, 1}, {9, -9, 1}, {0, 9, 1}};
    buffer.draw(two, x, 5);
    EXPECT_EQ(buffer.item(40, 40), 6);
    EXPECT_NEAR(buffer.depth(40, 40), 2.0, 1e-6);
    buffer.draw(std::vector<Triangle>{{0, 1, 2}}, x, 9);
    EXPECT_EQ(buffer.item(40, 40), 6);
    buffer.draw(std::vector<Triangle>{{5, 3, 4}}, x, 10);
    EXPECT_EQ(buffer.item(40, 40), 10);
  }
}

TEST(ItemBuffer, PeelsOneLayerAfterTheOther) {
  ItemBuffer buffer(camera(false));
  const std::vector<Triangle> three = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  const std::vector<Vec3> x = {{-9, -9, 0}, {9, -9, 0},   {0, 9, 0},   {-9, -9, 1}, {9, -9, 1},
                               {0, 9, 1},   {-9, -9, -1}, {9, -9, -1}, {0, 9, -1}};
  for (const int item : {1, 0, 2, ItemBuffer::none}) {
    buffer.draw(three, x);
    EXPECT_EQ(buffer.item(40, 40), item);
    buffer.peel();
  }
}

/// The plane z = x through the middle, seen by both projections.
TEST(ItemBuffer, DepthIsThatOfTheSurfaceAtTheSample) {
  const std::vector<Vec3> x = {{-2, -9, -2}, {2, -9, 2}, {0, 9, 0}};
  for (const bool orthographic : {true, false}) {
    ItemBuffer buffer(camera(orthographic));
    buffer.draw(std::vector<Triangle>{{0, 1, 2}}, x);
    for (const int column : {20, 39, 40, 60}) {
      const double u = (column + 0.5) / 40.0 - 1.0;  // of the picture's half width
      // x = u d / 3 and z = 3 - d = x.
      const double depth = orthographic ? 3.0 - u : 3.0 / (1.0 + u / 3.0);
      EXPECT_NEAR(buffer.depth(column, 40), depth, 1e-5) << orthographic << " " << column;
    }
  }
}

TEST(ItemBuffer, WhatIsBehindTheCameraIsCutOff) {
  for (const bool orthographic : {true, false}) {
    ItemBuffer buffer(camera(orthographic));
    // The floor y = -0.5, from far in front to far behind.
    const std::vector<Vec3> floor = {{-50, -0.5F, -50}, {50, -0.5F, -50}, {0, -0.5F, 50}};
    buffer.draw(std::vector<Triangle>{{0, 1, 2}}, floor);
    EXPECT_EQ(buffer.item(40, 10), ItemBuffer::none);
    if (!orthographic) {
      EXPECT_NEAR(buffer.depth(40, 79), 0.5 * 3.0 / (79.5 / 40.0 - 1.0), 1e-4);
    }
    const std::vector<Vec3> behind = {{-9, -9, 4}, {9, -9, 4}, {0, 9, 4}};
    ItemBuffer other(camera(orthographic));
    other.draw(std::vector<Triangle>{{0, 1, 2}}, behind);
    EXPECT_EQ(other.item(40, 40), ItemBuffer::none);
  }
}

TEST(ItemBuffer, ATriangleOnItsEdgeOrOutsideDrawsNothing) {
  ItemBuffer buffer(camera(false));
  const std::vector<Vec3> x = {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {50, 0, 0}, {51, 0, 0}, {50, 1, 0}};
  buffer.draw(std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}}, x);
  for (int y = 0; y < buffer.rows(); ++y)
    for (int column = 0; column < buffer.columns(); ++column)
      ASSERT_EQ(buffer.item(column, y), ItemBuffer::none);
  EXPECT_FALSE(buffer.holds(80, 0));
  EXPECT_FALSE(buffer.holds(-1, 0));
}

}  // namespace item_buffer_test
}  // namespace lagomorph::apps
