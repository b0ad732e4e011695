#include "render/raster/optics_stand_in.h"

#include <gtest/gtest.h>

#include "render/renderer.h"
#include "tests/unit/render/raster/shapes.h"

namespace lagomorph::render::raster {
namespace optics_stand_in_test {

TEST(OpticsStandIn, APlainMaterialIsItself) {
  const Material m{Color(0.1F, 0.3F, 0.34F), 0.4F, 0.2F, 1.4F};
  const Material drawn = optics_stand_in(m, 1.0F, ByRays{});
  EXPECT_EQ(drawn.base_color.matrix(), m.base_color.matrix());
  EXPECT_EQ(drawn.roughness, m.roughness);
  EXPECT_EQ(drawn.metallic, m.metallic);
  RenderScene scene;
  scene.meshes.emplace_back().material = m;
  EXPECT_TRUE(optics_remarks(scene, RasterSettings{}).empty());
  scene.meshes[0].name = "cast";
  scene.meshes[0].material.metallic = 1.0F;
  EXPECT_EQ(optics_remarks(scene, RasterSettings{}),
            std::vector<std::string>{"look of 'cast': it mirrors lights and sky, and no bodies"});
}

TEST(OpticsStandIn, InsidesShowTheirColours) {
  Material m;
  m.absorption_color = Color(0.9F, 0.1F, 0.2F);
  m.subsurface_color = Color(0.2F, 0.7F, 0.4F);
  m.transmission = 1.0F;
  EXPECT_LT((optics_stand_in(m, 1.0F, ByRays{}).base_color - m.absorption_color).abs().maxCoeff(), 1e-6F);
  m.transmission = 0.0F;
  m.subsurface = 0.5F;
  const Color half = 0.5F * (m.base_color + m.subsurface_color);
  EXPECT_LT((optics_stand_in(m, 1.0F, ByRays{}).base_color - half).abs().maxCoeff(), 1e-6F);
  m.metallic = 1.0F;
  EXPECT_EQ(optics_stand_in(m, 1.0F, ByRays{}).base_color.matrix(), m.base_color.matrix());
}

TEST(OpticsStandIn, AThickerInsideLetsLessThrough) {
  Material m;
  m.transmission = 1.0F;
  m.absorption_color = Color(0.9F, 0.5F, 0.2F);
  m.absorption_distance = 0.1F;
  const Color through = optics_stand_in(m, 0.3F, ByRays{}).base_color;
  EXPECT_LT((through - Color(0.729F, 0.125F, 0.008F)).abs().maxCoeff(), 1e-5F);
}

TEST(OpticsStandIn, TheMeanChordOfABallIsFourThirdsOfItsRadius) {
  const Mesh ball = sphere(Vec3(3.0F, -1.0F, 2.0F), 0.5F, 64);
  EXPECT_NEAR(mean_chord(ball.positions, ball.triangles), 4.0F / 3.0F * 0.5F, 1e-3F);
  EXPECT_EQ(mean_chord({}, {}), 0.0F);
}

TEST(OpticsStandIn, ACoatSharpens) {
  Material m;
  m.roughness = 0.8F;
  m.coat = 1.0F;
  m.coat_roughness = 0.1F;
  EXPECT_FLOAT_EQ(optics_stand_in(m, 1.0F, ByRays{}).roughness, 0.1F);
  m.roughness = 0.05F;
  EXPECT_FLOAT_EQ(optics_stand_in(m, 1.0F, ByRays{}).roughness, 0.05F);
}

TEST(RendererRemarks, SayWhatTheRasterizerDrawsInstead) {
  RenderScene scene;
  Mesh& mesh = scene.meshes.emplace_back();
  mesh.name = "jelly";
  mesh.material.transmission = 0.7F;
  mesh.material.sheen = 0.1F;
  RenderSettings settings;
  const std::vector<std::string> told = renderer_remarks(settings, {}, scene);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0],
            "raster: look of 'jelly': its shadow is as light as it is clear, without colours and "
            "caustics");
  settings.backend = "path";
  EXPECT_TRUE(renderer_remarks(settings, {}, scene).empty());
}

TEST(RendererRemarks, SayThatLightIsCut) {
  RenderSettings settings;
  settings.backend = "path";
  settings.path.clamp = 2.5F;
  const std::vector<std::string> told = renderer_remarks(settings, {}, {});
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0],
            "path: render.path.clamp = 2.5: indirect light above it is cut, so that pictures are "
            "somewhat too dark");
  settings.path.clamp = 0.0F;
  EXPECT_TRUE(renderer_remarks(settings, {}, {}).empty());
}

}  // namespace optics_stand_in_test
}  // namespace lagomorph::render::raster
