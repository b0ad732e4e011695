#include "render/ground_texture.h"

#include <cmath>

#include <gtest/gtest.h>

#include "render/error.h"
#include "render/renderer.h"

namespace lagomorph::render {
namespace ground_texture_test {

Ground ground(const char* texture) {
  Ground g;
  g.texture = texture;
  g.texture_size = 0.5F;
  g.line_width = 0.02F;
  g.material.base_color = Color(0.8F, 0.6F, 0.4F);
  g.texture_color = Color(0.1F, 0.2F, 0.3F);
  return g;
}

float at(const Ground& g, float x, float z) { return ground_texture_at(g, Vec3(x, 0.0F, z)); }

TEST(GroundTexture, OfACheckerChangesFromSquareToSquare) {
  const Ground g = ground("checker");
  for (int i = -3; i < 3; ++i) {
    for (int j = -3; j < 3; ++j) {
      const float x = 0.5F * (static_cast<float>(i) + 0.5F), z = 0.5F * (static_cast<float>(j) + 0.5F);
      EXPECT_EQ(at(g, x, z), (i + j) % 2 == 0 ? 0.0F : 1.0F) << i << ' ' << j;
    }
  }
}

TEST(GroundTexture, OfAGridIsWiderAtWholeMetres) {
  const Ground g = ground("grid");
  EXPECT_EQ(at(g, 0.509F, 0.25F), 1.0F);
  EXPECT_EQ(at(g, 0.511F, 0.25F), 0.0F);
  EXPECT_EQ(at(g, -0.25F, 0.509F), 1.0F);
  EXPECT_EQ(at(g, 1.029F, 0.25F), 1.0F);
  EXPECT_EQ(at(g, 1.031F, 0.25F), 0.0F);
  EXPECT_EQ(at(g, 0.25F, -2.029F), 1.0F);
}

TEST(GroundTexture, IsOneOfTwoColours) {
  const Ground g = ground("checker");
  EXPECT_EQ(ground_color_at(g, Vec3(0.1F, 0, 0.1F)).matrix(), g.material.base_color.matrix());
  EXPECT_EQ(ground_color_at(g, Vec3(0.6F, 0, 0.1F)).matrix(), g.texture_color.matrix());
  EXPECT_EQ(at(ground("none"), 0.5F, 0.5F), 0.0F);
}

TEST(GroundTexture, TellsWhatIsWrong) {
  RenderScene scene;
  scene.ground = ground("stripes");
  EXPECT_THROW(check_scene(scene), SettingsError);
  scene.ground = ground("grid");
  scene.ground.texture_size = 0.0F;
  EXPECT_THROW(check_scene(scene), SettingsError);
  scene.ground = ground("grid");
  scene.ground.texture_color = Color(2.0F, 0.0F, 0.0F);
  EXPECT_THROW(check_scene(scene), SettingsError);
}

/// Both back ends show the same floor, filtered as wide, lit by an even sky.
TEST(GroundTexture, IsTheSameInBothBackEnds) {
  for (const char* texture : {"checker", "grid"}) {
    RenderScene scene;
    scene.ground = ground(texture);
    scene.ground.material.roughness = 1.0F;
    scene.ground.material.ior = 1.0F;
    scene.sky.zenith = scene.sky.horizon = Color::Ones();
    scene.sky.strength = 1.0F;
    CameraSettings camera;
    camera.position = Vec3(0.3F, 1.5F, 3.0F);
    camera.look_at = Vec3(0.0F, 0.0F, 0.0F);
    std::vector<std::vector<float>> drawn;
    for (const char* back_end : {"raster", "path"}) {
      RenderSettings s;
      s.backend = back_end;
      s.width = 96;
      s.height = 64;
      s.samples = 256;
      s.path.bounces = 0;
      const auto renderer = make_renderer(s, 2);
      renderer->set_scene(scene);
      drawn.push_back(renderer->render(Camera(camera, s.width, s.height), {}).find(color_channel)->values);
    }
    double apart = 0.0, bias = 0.0, contrast = 0.0;
    for (std::size_t i = 0; i < drawn[0].size(); i += 3) {
      const double difference = static_cast<double>(drawn[0][i]) - drawn[1][i];
      apart += std::abs(difference);
      bias += difference;
      contrast += std::abs(static_cast<double>(drawn[1][i]) - 0.8);
    }
    const double pixels = 96.0 * 64.0;
    EXPECT_GT(contrast / pixels, 0.03) << texture;
    EXPECT_LT(apart / pixels, 0.02) << texture;
    EXPECT_LT(std::abs(bias) / pixels, 0.004) << texture;
  }
}

}  // namespace ground_texture_test
}  // namespace lagomorph::render
