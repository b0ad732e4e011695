#include "render/raster/light_view.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/render/raster/shapes.h"

namespace lagomorph::render::raster {
namespace light_view_test {

AreaLight some_light() {
  AreaLight light;
  light.position = Vec3(1.5F, 2.5F, -0.7F);
  light.look_at = Vec3(-0.2F, 0.4F, 0.1F);
  light.size = Vec2(0.8F, 0.5F);
  return light;
}

TEST(LightView, SeesEveryPositionAndItsDistance) {
  const AreaLight light = some_light();
  const LightFrame frame = light_frame(light);
  const std::vector<std::vector<Vec3>> positions = {sphere(Vec3(0.0F, 0.5F, 0.0F), 0.4F, 12).positions,
                                                    sphere(Vec3(0.6F, 0.1F, 0.3F), 0.1F, 6).positions};
  const LightView view = fit_light_view(light, positions, 1024);
  float largest_reciprocal = 0.0F;
  for (const auto& mesh : positions) {
    for (const Vec3& p : mesh) {
      const Eigen::Vector4f clip = view.clip_from_world * p.homogeneous();
      const Vec3 ndc = clip.head<3>() / clip.w();
      EXPECT_LT(ndc.cwiseAbs().maxCoeff(), 1.0F);
      const Vec3 d = p - light.position;
      const float z = d.dot(frame.normal);
      const Vec2 tangent(d.dot(frame.right) / z, d.dot(frame.up) / z);
      for (int k = 0; k < 2; ++k)
        EXPECT_NEAR(tangent[k] * view.map[k] + view.map[k + 2], 0.5F * ndc[k] + 0.5F, 1e-5F);
      EXPECT_NEAR((0.5F * ndc.z() + 0.5F) * view.depth.x() + view.depth.y(), 1.0F / z, 1e-5F);
      largest_reciprocal = std::max(largest_reciprocal, 1.0F / z);
    }
  }
  EXPECT_NEAR(view.depth.z(), largest_reciprocal, 1e-6F);
}

TEST(LightView, StandsStillWhileTheMeshMovesALittle) {
  const AreaLight light = some_light();
  std::vector<std::vector<Vec3>> positions = {sphere(Vec3(0.0F, 0.5F, 0.0F), 0.4F, 12).positions};
  int changes = 0;
  Vec4 before = fit_light_view(light, positions, 1024).map;
  for (int i = 0; i < 40; ++i) {
    for (Vec3& p : positions[0]) p.x() += 0.002F;
    const Vec4 now = fit_light_view(light, positions, 1024).map;
    changes += now == before ? 0 : 1;
    before = now;
  }
  EXPECT_LE(changes, 6);
  EXPECT_GE(changes, 1);  // it follows all the same
}

TEST(LightView, MeetsNothingBehindTheLight) {
  const std::vector<std::vector<Vec3>> positions = {{Vec3(3.0F, 5.0F, -1.5F)}};
  EXPECT_EQ(fit_light_view(some_light(), positions, 1024).depth, Vec4::Zero().eval());
  EXPECT_EQ(fit_light_view(some_light(), {}, 1024).depth, Vec4::Zero().eval());
}

}  // namespace light_view_test
}  // namespace lagomorph::render::raster
