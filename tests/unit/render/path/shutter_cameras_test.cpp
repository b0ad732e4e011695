#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "render/error.h"
#include "tests/unit/render/path/floating_square.h"

/// Cameras that move while the shutter is open.
namespace lagomorph::render {
namespace shutter_cameras_test {

using namespace floating_square;

/// The camera's own way while the shutter is open, at the scene's time steps.
template <class Way>
std::vector<Camera> cameras_of(int segments, const Way& settings_at) {
  std::vector<Camera> cameras;
  for (int step = 0; step <= segments; ++step)
    cameras.emplace_back(settings_at(static_cast<float>(step) / static_cast<float>(segments)), width, height);
  return cameras;
}

CameraSettings above_at(float x) {
  CameraSettings c = above();
  c.position.x() += x;
  c.look_at.x() += x;
  return c;
}

TEST(ShutterCameras, ACameraThatMovesBlursWhatStands) {
  RenderScene scene = floating(false);
  scene.motion_segments = 8;
  const auto renderer = make_path_renderer(settings(), 2);
  renderer->set_scene(scene);
  const std::vector<Camera> cameras = cameras_of(8, [](float t) { return above_at(-0.8F * t); });
  const std::vector<double> got =
      columns(renderer->render(cameras.back(), {.frame = 0, .time = 0.0, .shutter_cameras = cameras}));
  for (int x = 0; x < width; ++x) {
    const double at = middle_of(x);
    EXPECT_NEAR(got[static_cast<std::size_t>(x)], covered(at, 0.8), 0.02) << at;
  }
}

TEST(ShutterCameras, ACameraThatGoesAlongSeesItSharp) {
  RenderScene scene = floating(false);
  scene.motion_segments = 8;
  const auto x = [](float t) { return 1.7F * t * t; };
  const auto renderer = make_path_renderer(settings(), 2);
  renderer->set_scene(scene);
  const std::vector<double> still = columns(renderer->render(Camera(above(), width, height), {}));
  renderer->update_positions(0, shifted(scene, x(1.0F)));
  renderer->set_motion(0, steps_of(scene, x));
  const std::vector<Camera> cameras = cameras_of(8, [&](float t) { return above_at(x(t)); });
  const std::vector<double> got =
      columns(renderer->render(cameras.back(), {.frame = 0, .time = 0.0, .shutter_cameras = cameras}));
  for (std::size_t i = 0; i < width; ++i) EXPECT_NEAR(got[i], still[i], 0.01) << i;
}

/// A pull of focus: what is sharp half of the time is as blurred as the mean of the pictures at its times.
TEST(ShutterCameras, LensAndViewChangeWhileTheShutterIsOpen) {
  const auto lens = [](float t) {
    CameraSettings c = above();
    c.orthographic.reset();
    c.fov = 6.0F + 2.0F * t;
    c.f_stop = 0.4F;
    c.focus_distance = 2.0F + 4.0F * t;
    return c;
  };
  RenderScene scene = floating(false);
  scene.motion_segments = 8;
  RenderSettings s = settings();
  s.samples = 256;
  const auto renderer = make_path_renderer(s, 2);
  renderer->set_scene(scene);
  const std::vector<Camera> cameras = cameras_of(8, lens);
  const std::vector<double> got =
      columns(renderer->render(cameras.back(), {.frame = 0, .time = 0.0, .shutter_cameras = cameras}));
  std::vector<double> mean(width, 0.0);
  constexpr int times = 32;
  double apart = 0.0;
  for (int i = 0; i < times; ++i) {
    const Camera at(lens((static_cast<float>(i) + 0.5F) / times), width, height);
    const std::vector<double> then = columns(renderer->render(at, {.frame = i}));
    for (std::size_t x = 0; x < width; ++x) mean[x] += then[x] / times;
    if (i + 1 == times)
      for (std::size_t x = 0; x < width; ++x) apart = std::max(apart, std::abs(then[x] - got[x]));
  }
  for (std::size_t x = 0; x < width; ++x) EXPECT_NEAR(got[x], mean[x], 0.03) << x;
  EXPECT_GT(apart, 0.1);
}

/// Without a shutter the ways that are known of it change no bit.
TEST(ShutterCameras, NothingMovesWithoutSegments) {
  const RenderScene scene = [] {
    RenderScene s = floating(true);
    s.motion_segments = 0;
    s.lights = {AreaLight()};
    return s;
  }();
  RenderSettings s = settings();
  s.samples = 16;
  s.channels = {"denoising_depth"};
  const auto renderer = make_path_renderer(s, 2);
  renderer->set_scene(scene);
  const std::vector<Camera> cameras = cameras_of(8, [](float t) { return above_at(t); });
  const Image still = renderer->render(cameras.back(), {.frame = 3});
  const Image image = renderer->render(cameras.back(), {.frame = 3, .time = 0.1, .shutter_cameras = cameras});
  EXPECT_EQ(image.find("color")->values, still.find("color")->values);
  EXPECT_EQ(image.find("denoising_depth")->values, still.find("denoising_depth")->values);
  EXPECT_THROW(renderer->set_motion(0, Steps{scene.meshes[0].positions}), SettingsError);
}

/// Depths are along the axis of the camera at the path's time, here one that pans.
TEST(ShutterCameras, DepthIsThatOfTheCameraAtItsTime) {
  RenderScene scene = floating(false);
  scene.motion_segments = 8;
  scene.meshes = {make_quad(Vec3(-40, 0, 40), Vec3(80, 0, 0), Vec3(0, 0, -80))};
  RenderSettings s = settings();
  s.channels = {"denoising_depth"};
  const auto renderer = make_path_renderer(s, 2);
  renderer->set_scene(scene);
  const std::vector<Camera> cameras = cameras_of(8, [](float t) {
    CameraSettings c = above();
    c.look_at.x() = 6.0F * t - 3.0F;
    return c;
  });
  const Image image = renderer->render(cameras.back(), {.frame = 0, .time = 0.0, .shutter_cameras = cameras});
  const std::vector<float>& depths = image.find("denoising_depth")->values;
  for (int x = 0; x < width; ++x) {
    double mean = 0.0;
    constexpr int times = 1000;
    for (int i = 0; i < times; ++i) {
      // Orthographic rays go along the axis.
      const Ray ray = camera_at(cameras, (static_cast<float>(i) + 0.5F) / times)
                          .ray(static_cast<float>(x) + 0.5F, height / 2.0F);
      mean += static_cast<double>(-ray.origin.y() / ray.direction.y()) / times;
    }
    EXPECT_NEAR(depths[static_cast<std::size_t>(height / 2 * width + x)], mean, 0.03) << x;
  }
}

}  // namespace shutter_cameras_test
}  // namespace lagomorph::render
