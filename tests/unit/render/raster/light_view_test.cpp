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

TEST(LightView, ShadowedGroundHoldsAllThatIsHidden) {
  RenderScene scene = empty_scene();
  scene.ground.enabled = true;
  scene.ground.height = -0.2F;
  scene.lights = {some_light()};
  const Eigen::AlignedBox3f box(Vec3(-0.3F, 0.1F, -0.2F), Vec3(0.2F, 0.9F, 0.4F));
  const Vec4 hidden = shadowed_ground(scene, box);
  const LightFrame frame = light_frame(scene.lights[0]);
  float left = 1e9F;
  float front = -1e9F;
  for (int i = 0; i <= 10; ++i) {
    for (int k = 0; k <= 10; ++k) {
      const Vec3 from = scene.lights[0].position +
                        (0.1F * static_cast<float>(i) - 0.5F) * 0.8F * frame.right +
                        (0.1F * static_cast<float>(k) - 0.5F) * 0.5F * frame.up;
      for (int j = 0; j < 1000; ++j) {
        const Vec3 t(static_cast<float>(j % 10) / 9.0F, static_cast<float>(j / 10 % 10) / 9.0F,
                     static_cast<float>(j / 100) / 9.0F);
        const Vec3 p = box.min() + t.cwiseProduct(box.sizes());
        const Vec3 x = p + (from - p) * ((scene.ground.height - p.y()) / (from.y() - p.y()));
        EXPECT_TRUE(x.x() >= hidden[0] - 1e-4F && x.x() <= hidden[2] + 1e-4F && x.z() >= hidden[1] - 1e-4F &&
                    x.z() <= hidden[3] + 1e-4F)
            << x.transpose();
        left = std::min(left, x.x());
        front = std::max(front, x.z());
      }
    }
  }
  EXPECT_NEAR(hidden[0], left, 1e-4F);
  EXPECT_NEAR(hidden[3], front, 1e-4F);
}

TEST(LightView, ALowLightShadowsAllTheGround) {
  RenderScene scene = empty_scene();
  scene.ground.enabled = true;
  scene.ground.radius = 5.0F;
  scene.lights = {some_light()};
  scene.lights[0].position.y() = 0.8F;
  const Vec4 hidden = shadowed_ground(scene, {Vec3(-0.3F, 0.1F, -0.2F), Vec3(0.2F, 0.9F, 0.4F)});
  EXPECT_EQ(hidden, Vec4(-5.0F, -5.0F, 5.0F, 5.0F));
  scene.lights.clear();
  const Vec4 none = shadowed_ground(scene, {Vec3(-0.3F, 0.1F, -0.2F), Vec3(0.2F, 0.9F, 0.4F)});
  EXPECT_EQ(none, Vec4::Zero().eval());
}

}  // namespace light_view_test
}  // namespace lagomorph::render::raster
