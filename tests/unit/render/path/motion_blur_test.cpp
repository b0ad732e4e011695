#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "render/backends.h"
#include "tests/unit/render/path/shapes.h"

namespace lagomorph::render {
namespace motion_blur_test {

constexpr int width = 80, height = 8;
constexpr float span = 4.0F;  // width of the view [m]

RenderSettings settings() {
  RenderSettings s;
  s.backend = "path";
  s.width = width;
  s.height = height;
  s.samples = 1024;
  s.path.bounces = 0;
  s.path.filter = "box";
  s.path.filter_radius = 0.5F;
  return s;
}

/// A white square of side 1 that floats at y = 1 over a floor, seen from above; moving along x.
RenderScene floating(bool with_floor) {
  RenderScene scene;
  scene.ground.enabled = with_floor;
  scene.ground.radius = 100.0F;
  scene.ground.fade_start = 90.0F;
  scene.ground.material = {Color::Constant(0.5F), 1.0F, 0.0F, 1.0F};
  scene.sky.zenith = scene.sky.horizon = Color::Ones();
  scene.sky.strength = with_floor ? 0.0F : 1.0F;
  scene.background = Color::Zero();
  scene.meshes = {make_quad(Vec3(-0.5F, 1, 0.5F), Vec3(1, 0, 0), Vec3(0, 0, -1))};
  scene.meshes[0].material = {Color::Ones(), 1.0F, 0.0F, 1.0F};
  scene.moving = true;
  return scene;
}

CameraSettings above() {
  CameraSettings c;
  c.position = Vec3(0, 5, 0);
  c.look_at = Vec3::Zero();
  c.up = Vec3(0, 0, -1);
  c.orthographic = span * height / width;
  return c;
}

std::vector<Vec3> shifted(const RenderScene& scene, float x) {
  std::vector<Vec3> positions = scene.meshes[0].positions;
  for (Vec3& p : positions) p.x() += x;
  return positions;
}

/// Mean of a column's red, at the x of its middle.
std::vector<double> columns(const Image& image) {
  const std::vector<float>& values = image.find("color")->values;
  std::vector<double> sums(width, 0.0);
  for (std::size_t i = 0; i < values.size(); i += 3) sums[i / 3 % width] += values[i] / height;
  return sums;
}

/// Part of the time that a square of side 1, its middle going from 0 to `to`, is over x.
double covered(double x, double to) {
  const double from_time = (x - 0.5) / to;
  const double to_time = (x + 0.5) / to;
  return std::max(
      std::clamp(std::max(from_time, to_time), 0.0, 1.0) - std::clamp(std::min(from_time, to_time), 0.0, 1.0),
      0.0);
}

TEST(MotionBlur, ASquareIsThereForItsPartOfTheTime) {
  const RenderScene scene = floating(false);
  for (const float to : {0.4F, 1.7F}) {
    const auto renderer = make_path_renderer(settings(), 2);
    renderer->set_scene(scene);
    renderer->update_positions(0, shifted(scene, to));
    renderer->set_opening(0, scene.meshes[0].positions);
    const std::vector<double> got = columns(renderer->render(Camera(above(), width, height), {}));
    const double full = *std::max_element(got.begin(), got.end()) / std::min(1.0F / to, 1.0F);
    EXPECT_NEAR(full, 1.0, 0.02);  // albedo 1 under a sky of 1
    for (int x = 0; x < width; ++x) {
      const double at = (x + 0.5) * static_cast<double>(span) / width - static_cast<double>(span) / 2.0;
      EXPECT_NEAR(got[static_cast<std::size_t>(x)], covered(at, static_cast<double>(to)), 0.02)
          << to << " " << at;
    }
  }
}

TEST(MotionBlur, ItsShadowGoesWithIt) {
  // A sun at 45 degrees throws the shadow of the square, at y = 1, by 1 along x: beside the square, on the
  // floor, the light that is left is the time without shadow.
  RenderScene scene = floating(true);
  Sun sun;
  sun.direction = Vec3(1, -1, 0);
  sun.angle = 0.01F;
  sun.irradiance = 1.0F;
  scene.suns = {sun};
  const auto renderer = make_path_renderer(settings(), 2);
  renderer->set_scene(scene);
  renderer->update_positions(0, shifted(scene, 0.4F));
  renderer->set_opening(0, scene.meshes[0].positions);
  const std::vector<double> got = columns(renderer->render(Camera(above(), width, height), {}));
  const double lit = 0.5 / std::numbers::pi * std::sqrt(0.5);
  int tried = 0;
  for (int x = 0; x < width; ++x) {
    const double at = (x + 0.5) * static_cast<double>(span) / width - static_cast<double>(span) / 2.0;
    if (at < 0.95) continue;  // the square itself
    EXPECT_NEAR(got[static_cast<std::size_t>(x)] / lit, 1.0 - covered(at - 1.0, 0.4), 0.02) << at;
    ++tried;
  }
  EXPECT_GT(tried, 15);
}

TEST(MotionBlur, WhatIsMovedWithoutAnOpeningStandsStill) {
  RenderScene scene = floating(false);
  const Camera camera(above(), width, height);
  const auto moving = make_path_renderer(settings(), 2);
  moving->set_scene(scene);
  moving->update_positions(0, shifted(scene, 0.8F));
  moving->set_opening(0, scene.meshes[0].positions);
  (void)moving->render(camera, {});
  moving->update_positions(0, shifted(scene, 0.8F));
  const std::vector<double> still = columns(moving->render(camera, {}));
  scene.moving = false;
  const auto sharp = make_path_renderer(settings(), 2);
  sharp->set_scene(scene);
  sharp->update_positions(0, shifted(scene, 0.8F));
  const std::vector<double> expected = columns(sharp->render(camera, {}));
  for (std::size_t x = 0; x < width; ++x) EXPECT_NEAR(still[x], expected[x], 0.01) << x;
}

TEST(MotionBlur, SameBitsForAnyThreadsAndWhateverWasDrawnBefore) {
  RenderScene scene = floating(true);
  scene.meshes.push_back(make_sphere(4, 0.4F, Vec3(0.5F, 0.6F, 0)));
  scene.lights = {AreaLight()};
  std::vector<Vec3> opening = scene.meshes[1].positions;
  for (Vec3& p : opening) p.y() += 0.3F;
  const Camera camera(above(), width, height);
  RenderSettings s = settings();
  s.samples = 16;
  s.path.bounces = 3;
  const auto draw = [&](Renderer& renderer, int frame) {
    renderer.update_positions(0, shifted(scene, 0.1F * static_cast<float>(frame)));
    renderer.set_opening(0, scene.meshes[0].positions);
    renderer.update_positions(1, scene.meshes[1].positions);
    renderer.set_opening(1, opening);
    return renderer.render(camera, {frame, 0.0}).find("color")->values;
  };
  const auto one = make_path_renderer(s, 1);
  one->set_scene(scene);
  const std::vector<float> third = draw(*one, 3);
  const auto four = make_path_renderer(s, 4);
  four->set_scene(scene);
  EXPECT_NE(draw(*four, 1), third);
  EXPECT_EQ(draw(*four, 3), third);
}

}  // namespace motion_blur_test
}  // namespace lagomorph::render
