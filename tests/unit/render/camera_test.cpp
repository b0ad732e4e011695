#include "render/camera.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace lagomorph::render {
namespace camera_test {

CameraSettings around(float angle) {
  CameraSettings c;
  c.position = Vec3(3.0F * std::sin(angle), 1.0F, 3.0F * std::cos(angle));
  c.look_at = Vec3(0, 1, 0);
  c.f_stop = 0.5F;
  return c;
}

/// Of a turn about what is looked at, every part of the way looks at it as well, upright.
TEST(Camera, BetweenTwoIsOneOfTheSameKind) {
  CameraSettings wide = around(0.2F);
  wide.fov = 50.0F;
  wide.f_stop = 1.0F;
  wide.focus_distance = 7.0F;
  const Camera a(around(-0.2F), 64, 48), b(wide, 64, 48);
  const Camera c = Camera::between(a, b, 0.5F);
  EXPECT_LT((c.forward() - Vec3(0, 0, -1)).norm(), 1e-6F);
  EXPECT_LT((c.right() - Vec3(1, 0, 0)).norm(), 1e-6F);
  EXPECT_LT((c.up() - Vec3(0, 1, 0)).norm(), 1e-6F);
  EXPECT_LT((c.position() - Vec3(0, 1, 3.0F * std::cos(0.2F))).norm(), 1e-6F);
  EXPECT_FLOAT_EQ(c.focus_distance(), 5.0F);
  EXPECT_FLOAT_EQ(c.lens_radius(), 0.5F * (a.lens_radius() + b.lens_radius()));
  EXPECT_FLOAT_EQ(c.pixel_size(1.0F), 0.5F * (a.pixel_size(1.0F) + b.pixel_size(1.0F)));
  EXPECT_FLOAT_EQ(Camera::between(a, b, 0.25F).focus_distance(), 4.0F);
  for (const float part : {0.0F, 0.3F, 0.8F, 1.0F}) {
    const Camera d = Camera::between(a, b, part);
    EXPECT_NEAR(d.right().norm(), 1.0F, 1e-6F) << part;
    EXPECT_NEAR(d.right().dot(d.forward()), 0.0F, 1e-6F) << part;
    EXPECT_LT((d.right().cross(d.forward()) - d.up()).norm(), 1e-6F) << part;
  }
  EXPECT_EQ(Camera::between(a, b, 1.0F).ray(3, 5).direction, b.ray(3, 5).direction);
  EXPECT_LT((Camera::between(a, b, 0.0F).ray(3, 5).direction - a.ray(3, 5).direction).norm(), 1e-6F);
}

TEST(Camera, OppositeWaysHaveNothingBetween) {
  const Camera a(around(0.0F), 8, 8), b(around(std::numbers::pi_v<float>), 8, 8);
  EXPECT_LT((Camera::between(a, b, 0.4F).forward() - a.forward()).norm(), 1e-5F);
  EXPECT_EQ(Camera::between(a, b, 0.5F).forward(), b.forward());
  EXPECT_LT((Camera::between(a, b, 0.6F).forward() - b.forward()).norm(), 1e-5F);
}

TEST(Camera, AtATimeIsBetweenTheTwoAroundIt) {
  std::vector<Camera> cameras;
  for (const float x : {0.0F, 1.0F, 5.0F}) {
    CameraSettings c;
    c.position.x() = c.look_at.x() = x;
    cameras.emplace_back(c, 8, 8);
  }
  const auto x = [&](float time) { return camera_at(cameras, time).position().x(); };
  EXPECT_FLOAT_EQ(x(0.0F), 0.0F);
  EXPECT_FLOAT_EQ(x(0.25F), 0.5F);
  EXPECT_FLOAT_EQ(x(0.5F), 1.0F);
  EXPECT_FLOAT_EQ(x(0.75F), 3.0F);
  EXPECT_FLOAT_EQ(x(1.0F), 5.0F);
}

}  // namespace camera_test
}  // namespace lagomorph::render
