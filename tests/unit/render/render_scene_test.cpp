#include "render/render_scene.h"

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "render/error.h"

namespace lagomorph::render {
namespace render_scene_test {

RenderScene small_scene() {
  RenderScene scene;
  scene.meshes.push_back({"leaf", {{0, 1, 2}}, {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}, {}, true, 0});
  scene.lights.emplace_back();
  return scene;
}

TEST(RenderScene, AScenesDefaultsAreSound) { EXPECT_NO_THROW(check_scene(small_scene())); }

TEST(RenderScene, EachWrongValueIsNamed) {
  const struct {
    const char* names;
    std::function<void(RenderScene&)> spoil;
  } cases[] = {
      {"mesh 'leaf' triangle 0 has vertex 3", [](RenderScene& s) { s.meshes[0].triangles[0][1] = 3; }},
      {"mesh 'leaf' position",
       [](RenderScene& s) { s.meshes[0].positions[1].y() = std::numeric_limits<float>::quiet_NaN(); }},
      {"mesh 'leaf' roughness", [](RenderScene& s) { s.meshes[0].material.roughness = 1.5F; }},
      {"mesh 'leaf' metallic", [](RenderScene& s) { s.meshes[0].material.metallic = -0.5F; }},
      {"mesh 'leaf' ior", [](RenderScene& s) { s.meshes[0].material.ior = 0.9F; }},
      {"mesh 'leaf' base_color", [](RenderScene& s) { s.meshes[0].material.base_color[2] = 1.1F; }},
      {"mesh 'leaf' body_id", [](RenderScene& s) { s.meshes[0].body_id = -1; }},
      {"light 0 position and look_at", [](RenderScene& s) { s.lights[0].look_at = s.lights[0].position; }},
      {"light 0 size", [](RenderScene& s) { s.lights[0].size.x() = 0.0F; }},
      {"light 0 radiance", [](RenderScene& s) { s.lights[0].radiance = -1.0F; }},
      {"ground radius", [](RenderScene& s) { s.ground.radius = 0.0F; }},
      {"ground fade_start", [](RenderScene& s) { s.ground.fade_start = s.ground.radius; }},
      {"sky strength", [](RenderScene& s) { s.sky.strength = -1.0F; }},
      {"background", [](RenderScene& s) { s.background = Color(0.0F, -1.0F, 0.0F); }},
  };
  for (const auto& c : cases) {
    RenderScene scene = small_scene();
    c.spoil(scene);
    try {
      check_scene(scene);
      ADD_FAILURE() << "no error: " << c.names;
    } catch (const SettingsError& error) {
      EXPECT_NE(std::string(error.what()).find(c.names), std::string::npos) << error.what();
    }
  }
}

TEST(RenderScene, LightFrameIsRightHandedAndUpright) {
  const Vec3 targets[] = {{1, -2, 0.5F}, {0, -1, 0}, {0, 1, 0}, {1e-6F, -1, 0}, {0, 0, 1}, {-1, 0.2F, -3}};
  for (const Vec3& target : targets) {
    AreaLight light;
    light.position = Vec3::Zero();
    light.look_at = target;
    const LightFrame f = light_frame(light);
    EXPECT_NEAR((f.normal - target.normalized()).norm(), 0.0F, 1e-6F);
    Eigen::Matrix3f axes;
    axes << f.right, f.up, -f.normal;
    EXPECT_NEAR((axes.transpose() * axes - Eigen::Matrix3f::Identity()).norm(), 0.0F, 1e-5F);
    EXPECT_NEAR(axes.determinant(), 1.0F, 1e-5F);
    EXPECT_GE(f.up.y(), 0.0F);
    EXPECT_NEAR(f.right.y(), 0.0F, 1e-6F);
  }
}

TEST(RenderScene, SkyBlendsByTheRootOfTheHeight) {
  const Sky sky{{0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}, 2.0F};
  EXPECT_NEAR(sky_radiance(sky, Vec3::UnitY())[2], 2.0F, 1e-6F);
  EXPECT_NEAR(sky_radiance(sky, Vec3::UnitX())[0], 2.0F, 1e-6F);
  EXPECT_NEAR(sky_radiance(sky, -Vec3::UnitY())[0], 2.0F, 1e-6F);
  const Color mid = sky_radiance(sky, Vec3(std::sqrt(1.0F - 0.0625F), 0.0625F, 0.0F));
  EXPECT_NEAR(mid[2], 0.5F, 1e-3F);
}

TEST(RenderScene, GroundFadesSmoothlyFromItsStartToItsRadius) {
  Ground ground;
  ground.center = Vec3(1.0F, 5.0F, -2.0F);
  ground.fade_start = 2.0F;
  ground.radius = 6.0F;
  const auto at = [&](float d) { return ground_fade(ground, Vec3(1.0F + d, -3.0F, -2.0F)); };
  EXPECT_EQ(at(0.0F), 0.0F);
  EXPECT_EQ(at(2.0F), 0.0F);
  EXPECT_NEAR(at(4.0F), 0.5F, 1e-6F);
  EXPECT_NEAR(at(3.0F), 0.15625F, 1e-6F);
  EXPECT_EQ(at(6.0F), 1.0F);
  EXPECT_EQ(at(60.0F), 1.0F);
}

}  // namespace render_scene_test
}  // namespace lagomorph::render
