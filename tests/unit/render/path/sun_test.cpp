#include "render/path/sun.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "render/backends.h"
#include "render/path/brdf.h"
#include "tests/unit/render/path/shapes.h"

namespace lagomorph::render::path {
namespace sun_test {

constexpr double pi = std::numbers::pi;

TEST(SunLight, SamplesLieInItsDiscAndGiveItsIrradiance) {
  for (const float angle : {0.01F, 0.53F, 10.0F, 90.0F}) {
    Sun sun;
    sun.angle = angle;
    sun.irradiance = 2.0F;
    const SunLight light(sun);
    const Vec3 middle = -sun.direction.normalized();
    const FrameSamples numbers(0, 0, 4096);
    double irradiance = 0.0;
    for (int s = 0; s < 4096; ++s) {
      const Vec3 d = light.sample(numbers.path(0, 0, s).pair(0));
      // Just inside, lest rounding put a sample of the border beside it.
      ASSERT_TRUE(light.contains((d + 1e-3F * (middle - d)).normalized()) || angle < 0.1F);
      irradiance += static_cast<double>(light.radiance().x()) * std::max(d.dot(middle), 0.0F) / light.pdf();
    }
    EXPECT_NEAR(irradiance / 4096, 2.0, 2e-3) << angle;
    EXPECT_FALSE(light.contains(-middle));
  }
}

RenderScene lit_ground(float angle) {
  RenderScene scene;
  scene.ground.radius = 10.0F;
  scene.ground.fade_start = 9.0F;
  scene.ground.material = {Color::Constant(0.5F), 1.0F, 0.0F, 1.0F};
  scene.sky.strength = 0.0F;
  Sun sun;
  sun.direction = Vec3(1.0F, -1.0F, 0.0F);
  sun.angle = angle;
  sun.irradiance = 3.0F;
  sun.color = Color(1.0F, 0.5F, 0.25F);
  scene.suns = {sun};
  return scene;
}

std::vector<float> draw(const RenderScene& scene, float x, float size, int width, const std::string& backend,
                        int samples = 256) {
  RenderSettings s;
  s.backend = backend;
  s.width = width;
  s.height = 4;
  s.samples = samples;
  s.path.bounces = 0;
  s.path.filter = "box";
  s.path.filter_radius = 0.5F;
  CameraSettings c;
  c.position = Vec3(x, 5.0F, 0.0F);
  c.look_at = Vec3(x, 0.0F, 0.0F);
  c.up = Vec3(0, 0, -1);
  c.orthographic = size;
  const auto renderer = make_renderer(s, 2);
  renderer->set_scene(scene);
  return renderer->render(Camera(c, s.width, s.height), {}).find("color")->values;
}

TEST(SunLight, GroundIsLitByTheCosine) {
  // albedo / pi * E cos 45, in both back ends.
  const double expected = 0.5 / pi * 3.0 * std::sqrt(0.5);
  for (const char* backend : {"path", "raster"}) {
    const std::vector<float> values = draw(lit_ground(0.53F), 0.0F, 0.5F, 4, backend);
    for (std::size_t i = 0; i < values.size(); i += 3) {
      EXPECT_NEAR(values[i], expected, 3e-3 * expected) << backend;
      EXPECT_NEAR(values[i + 1], 0.5 * expected, 3e-3 * expected) << backend;
      EXPECT_NEAR(values[i + 2], 0.25 * expected, 3e-3 * expected) << backend;
    }
  }
}

TEST(SunLight, ThePenumbraIsAsWideAsItsAngle) {
  // The upper edge of a wall at x = 0, height 1: the shadow's edge falls at x = 1, and 10 to 90 % of the
  // light of a disc lie within +-0.687 of the half angle [cap fraction 0.1]; the plane is met at 45 degrees,
  // so lengths along x are 1 / sin^2 45 times the angle, at the edge's height of 1.
  RenderScene scene = lit_ground(4.0F);
  scene.meshes = {make_quad(Vec3(0, -0.5F, -3), Vec3(0, 1.5F, 0), Vec3(0, 0, 6))};
  const int width = 200;
  const float span = 0.4F;
  const std::vector<float> values = draw(scene, 1.0F, 4.0F * span / width, width, "path", 1024);
  const auto light = [&](int x) {
    double sum = 0.0;
    for (int y = 0; y < 4; ++y) sum += values[static_cast<std::size_t>(3 * (y * width + x))];
    return sum / 4.0 / (0.5 / pi * 3.0 * std::sqrt(0.5));
  };
  const auto crossing = [&](double level) {
    int x = 0;
    while (x < width && light(x) < level) ++x;
    return (x + 0.5) * static_cast<double>(span) / width - static_cast<double>(span) / 2.0;
  };
  EXPECT_NEAR(light(2), 0.0, 1e-3);
  EXPECT_NEAR(light(width - 3), 1.0, 0.02);
  const double half = 2.0 * pi / 180.0;
  EXPECT_NEAR(crossing(0.9) - crossing(0.1), 2.0 * 2.0 * 0.687 * half, 0.06 * 2.0 * 2.0 * half);
  EXPECT_NEAR(crossing(0.5), 0.0, 0.006);
}

TEST(SunLight, EveryRoughnessReflectsItAsQuadratureSays) {
  // Of a metal plane seen from straight above, under a disc 60 degrees wide overhead: the BRDF over the disc.
  RenderScene scene = lit_ground(60.0F);
  scene.suns[0].direction = Vec3(0.0F, -1.0F, 0.0F);
  const double radiance = 3.0 / (pi * std::pow(std::sin(pi / 6.0), 2.0));
  for (const float roughness : {0.0F, 0.3F, 0.6F, 1.0F}) {
    scene.ground.material = {Color::Ones(), roughness, 1.0F, 1.5F};
    double expected = radiance;  // a mirror shows it
    if (roughness > 0.0F) {
      const Brdf brdf(scene.ground.material);
      const Brdf::View view = brdf.view(Vec3(0, 0, 1));
      double sum = 0.0;
      constexpr int n = 2000;
      for (int i = 0; i < n; ++i) {
        const double theta = pi / 6.0 * (i + 0.5) / n;
        const Vec3 wi(static_cast<float>(std::sin(theta)), 0.0F, static_cast<float>(std::cos(theta)));
        sum += static_cast<double>(brdf.evaluate(view, wi).f_cos.x()) * std::sin(theta);
      }
      expected = radiance * 2.0 * pi * sum * (pi / 6.0) / n;
    }
    const std::vector<float> values = draw(scene, 0.0F, 0.2F, 4, "path", 4096);
    double mean = 0.0;
    for (std::size_t i = 0; i < values.size(); i += 3) mean += static_cast<double>(values[i]);
    mean /= static_cast<double>(values.size()) / 3.0;
    EXPECT_NEAR(mean, expected, 5e-3 * expected) << roughness;
  }
}

TEST(SunLight, TheCameraSeesAVisibleOneWhereThereIsNoBackground) {
  RenderScene scene = lit_ground(2.0F);
  scene.ground.enabled = false;
  scene.suns[0].direction = Vec3(0.0F, 0.0F, 1.0F);
  RenderSettings s;
  s.backend = "path";
  s.width = s.height = 8;
  s.samples = 4;
  CameraSettings c;
  c.position = Vec3::Zero();
  c.look_at = Vec3(0, 0, -1);
  c.fov = 1.0F;
  const auto middle = [&] {
    const auto renderer = make_path_renderer(s, 1);
    renderer->set_scene(scene);
    return renderer->render(Camera(c, 8, 8), {}).find("color")->values[3 * 36];
  };
  EXPECT_EQ(middle(), 0.0F);
  scene.suns[0].visible = true;
  const double radiance = 3.0 / (pi * std::pow(std::sin(pi / 180.0), 2.0));
  EXPECT_NEAR(middle(), radiance, 1e-3 * radiance);
  scene.background = Color::Constant(0.25F);
  EXPECT_EQ(middle(), 0.25F);
}

}  // namespace sun_test
}  // namespace lagomorph::render::path
