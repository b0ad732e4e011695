#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "render/error.h"
#include "tests/unit/render/path/floating_square.h"

namespace lagomorph::render {
namespace motion_blur_test {

using namespace floating_square;

TEST(MotionBlur, ASquareIsThereForItsPartOfTheTime) {
  const RenderScene scene = floating(false);
  for (const float to : {0.4F, 1.7F}) {
    const auto renderer = make_path_renderer(settings(), 2);
    renderer->set_scene(scene);
    renderer->update_positions(0, shifted(scene, to));
    renderer->set_motion(0, Steps{scene.meshes[0].positions});
    const std::vector<double> got = columns(renderer->render(Camera(above(), width, height), {}));
    const double full = *std::max_element(got.begin(), got.end()) / std::min(1.0F / to, 1.0F);
    EXPECT_NEAR(full, 1.0, 0.02);  // albedo 1 under a sky of 1
    for (int x = 0; x < width; ++x) {
      const double at = middle_of(x);
      EXPECT_NEAR(got[static_cast<std::size_t>(x)], covered(at, static_cast<double>(to)), 0.02)
          << to << " " << at;
    }
  }
}

TEST(MotionBlur, ManySegmentsFollowWhatGetsFaster) {
  RenderScene scene = floating(false);
  scene.motion_segments = 8;
  constexpr double to = 1.7;
  const auto x = [](float t) { return static_cast<float>(to) * t * t; };
  const auto renderer = make_path_renderer(settings(), 2);
  renderer->set_scene(scene);
  renderer->update_positions(0, shifted(scene, static_cast<float>(to)));
  renderer->set_motion(0, steps_of(scene, x));
  const std::vector<double> got = columns(renderer->render(Camera(above(), width, height), {}));
  double other = 0.0;  // than at an even pace
  for (int column = 0; column < width; ++column) {
    const double at = middle_of(column);
    double there = 0.0;
    constexpr int times = 8000;
    for (int i = 0; i < times; ++i) {
      const double along = 8.0 * (i + 0.5) / times, k = std::floor(along), f = along - k;
      const double middle = to * ((1.0 - f) * k * k + f * (k + 1.0) * (k + 1.0)) / 64.0;
      if (std::abs(at - middle) < 0.5) there += 1.0 / times;
    }
    EXPECT_NEAR(got[static_cast<std::size_t>(column)], there, 0.02) << at;
    other = std::max(other, std::abs(there - covered(at, to)));
  }
  EXPECT_GT(other, 0.1);
}

TEST(MotionBlur, AnEvenPaceIsTheSameInAnyNumberOfSegments) {
  RenderSettings s = settings();
  s.samples = 64;
  const auto draw = [&](int segments) {
    RenderScene scene = floating(true);
    scene.lights = {AreaLight()};
    scene.motion_segments = segments;
    const auto renderer = make_path_renderer(s, 2);
    renderer->set_scene(scene);
    renderer->update_positions(0, shifted(scene, 0.8F));
    renderer->set_motion(0, steps_of(scene, [](float t) { return 0.8F * t; }));
    return renderer->render(Camera(above(), width, height), {}).find("color")->values;
  };
  const std::vector<float> one = draw(1), eight = draw(8);
  double mean = 0.0, rms = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    mean += static_cast<double>(one[i]) / static_cast<double>(one.size());
    rms += std::pow(static_cast<double>(one[i] - eight[i]), 2.0) / static_cast<double>(one.size());
  }
  // Rounding moves an edge over single samples.
  EXPECT_LT(std::sqrt(rms), 1e-3 * mean);
  EXPECT_GT(mean, 0.01);
}

TEST(MotionBlur, OtherNumbersOfTimesOrPositionsAreRefused) {
  RenderScene scene = floating(false);
  scene.motion_segments = 2;
  const auto renderer = make_path_renderer(settings(), 1);
  renderer->set_scene(scene);
  const std::vector<Vec3> there = scene.meshes[0].positions, fewer(there.begin(), there.end() - 1);
  EXPECT_THROW(renderer->set_motion(0, Steps{there}), SettingsError);
  EXPECT_THROW(renderer->set_motion(0, Steps{there, fewer}), SettingsError);
  EXPECT_NO_THROW(renderer->set_motion(0, Steps{there, there}));
  for (const int segments : {-1, 129}) {
    scene.motion_segments = segments;
    EXPECT_THROW(renderer->set_scene(scene), SettingsError);
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
  renderer->set_motion(0, Steps{scene.meshes[0].positions});
  const std::vector<double> got = columns(renderer->render(Camera(above(), width, height), {}));
  const double lit = 0.5 / std::numbers::pi * std::sqrt(0.5);
  int tried = 0;
  for (int x = 0; x < width; ++x) {
    const double at = middle_of(x);
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
  moving->set_motion(0, Steps{scene.meshes[0].positions});
  (void)moving->render(camera, {});
  moving->update_positions(0, shifted(scene, 0.8F));
  const std::vector<double> still = columns(moving->render(camera, {}));
  scene.motion_segments = 0;
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
  scene.motion_segments = 3;
  std::vector<Vec3> opening = scene.meshes[1].positions;
  for (Vec3& p : opening) p.y() += 0.3F;
  const Camera camera(above(), width, height);
  RenderSettings s = settings();
  s.samples = 16;
  s.path.bounces = 3;
  const auto draw = [&](Renderer& renderer, int frame) {
    renderer.update_positions(0, shifted(scene, 0.1F * static_cast<float>(frame)));
    renderer.set_motion(0, Steps(3, scene.meshes[0].positions));
    renderer.update_positions(1, scene.meshes[1].positions);
    renderer.set_motion(1, Steps{opening, opening, scene.meshes[1].positions});
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
