#include "render/ground_texture.h"

#include <cmath>
#include <cstddef>
#include <vector>

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

/// Mean of |raster - path| of a floor under an even sky, the mean of the difference, and of the contrast.
struct FloorsApart {
  double apart = 0.0, bias = 0.0, contrast = 0.0;
};
FloorsApart floors_apart(const Ground& floor, const CameraSettings& camera, int samples) {
  RenderScene scene;
  scene.ground = floor;
  scene.ground.material.roughness = 1.0F;
  scene.ground.material.ior = 1.0F;
  scene.sky.zenith = scene.sky.horizon = Color::Ones();
  scene.sky.strength = 1.0F;
  std::vector<std::vector<float>> drawn;
  for (const char* back_end : {"raster", "path"}) {
    RenderSettings s;
    s.backend = back_end;
    s.width = 96;
    s.height = 64;
    s.samples = samples;
    s.path.bounces = 0;
    const auto renderer = make_renderer(s, 2);
    renderer->set_scene(scene);
    drawn.push_back(renderer->render(Camera(camera, s.width, s.height), {}).find(color_channel)->values);
  }
  FloorsApart sum;
  for (std::size_t i = 0; i < drawn[0].size(); i += 3) {
    const double difference = static_cast<double>(drawn[0][i]) - static_cast<double>(drawn[1][i]);
    constexpr double part = 1.0 / (96.0 * 64.0);
    sum.apart += part * std::abs(difference);
    sum.bias += part * difference;
    sum.contrast += part * std::abs(static_cast<double>(drawn[1][i]) - 0.8);
  }
  return sum;
}

/// Both back ends show the same floor, filtered as wide.
TEST(GroundTexture, IsTheSameInBothBackEnds) {
  CameraSettings camera;
  camera.position = Vec3(0.3F, 1.5F, 3.0F);
  camera.look_at = Vec3(0.0F, 0.0F, 0.0F);
  for (const char* texture : {"checker", "grid"}) {
    const FloorsApart floors = floors_apart(ground(texture), camera, 256);
    EXPECT_GT(floors.contrast, 0.03) << texture;
    EXPECT_LT(floors.apart, 0.02) << texture;
    EXPECT_LT(std::abs(floors.bias), 0.004) << texture;
  }
}

/// Towards the horizon, where squares are far smaller than pixels: no moire; aslant, where they blur along
/// their rows' diagonals, and turned by other angles.
TEST(GroundTexture, IsTheSameAtTheHorizon) {
  Ground floor = ground("checker");
  floor.radius = 300.0F;
  floor.fade_start = 200.0F;
  for (const float turn : {0.0F, 0.3F, 0.785398F}) {
    CameraSettings camera;
    camera.position = Vec3(0.1F, 0.8F, 0.0F);
    camera.look_at = Vec3(0.1F + 10.0F * std::sin(turn), 0.0F, -10.0F * std::cos(turn));
    camera.fov = 14.0F;
    const FloorsApart floors = floors_apart(floor, camera, 1024);
    EXPECT_GT(floors.contrast, 0.03) << turn;
    EXPECT_LT(floors.apart, 0.012) << turn;
    EXPECT_LT(std::abs(floors.bias), 0.004) << turn;
  }
}

}  // namespace ground_texture_test
}  // namespace lagomorph::render
