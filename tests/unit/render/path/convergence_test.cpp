#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "render/renderer.h"
#include "tests/unit/render/path/shapes.h"

/// How fast noise falls with the samples.
namespace lagomorph::render {
namespace convergence_test {

constexpr int width = 32, height = 24, pictures = 16;

/// A sphere on the ground, under an area light and the sky.
RenderScene scene_of_test() {
  RenderScene scene;
  scene.meshes = {make_sphere(3, 0.5F, Vec3(0, 0.5F, 0))};
  scene.meshes[0].material.base_color = Color(0.7F, 0.4F, 0.3F);
  scene.lights.resize(1);
  return scene;
}

/// Variance of a pixel's luminance over pictures of other frames, which have other numbers, in the mean over
/// the pixels.
double variance(int samples) {
  RenderSettings settings;
  settings.backend = "path";
  settings.width = width;
  settings.height = height;
  settings.samples = samples;
  settings.path.bounces = 2;
  const auto renderer = make_renderer(settings, 2);
  renderer->set_scene(scene_of_test());
  CameraSettings view;
  view.position = Vec3(0.8F, 1.0F, 2.4F);
  view.look_at = Vec3(0, 0.4F, 0);
  const Camera camera(view, width, height);
  std::vector<double> sum(width * height, 0.0), squares(width * height, 0.0);
  for (int frame = 0; frame < pictures; ++frame) {
    const std::vector<float> light = renderer->render(camera, {.frame = frame}).find(color_channel)->values;
    for (std::size_t i = 0; i < sum.size(); ++i) {
      const double y = 0.2126 * static_cast<double>(light[3 * i]) +
                       0.7152 * static_cast<double>(light[3 * i + 1]) +
                       0.0722 * static_cast<double>(light[3 * i + 2]);
      sum[i] += y;
      squares[i] += y * y;
    }
  }
  double all = 0.0;
  for (std::size_t i = 0; i < sum.size(); ++i)
    all += (squares[i] - sum[i] * sum[i] / pictures) / (pictures - 1) / (width * height);
  return all;
}

/// Independent samples give a slope of -1. Scrambled Sobol points do no worse and, where the integrand has
/// edges (shadows, silhouettes) in few dimensions, up to -1.5.
TEST(PathConvergence, VarianceFallsAsOneOverTheSamplesOverFourOctaves) {
  std::vector<double> logs;
  for (const int samples : {4, 8, 16, 32, 64}) logs.push_back(std::log2(variance(samples)));
  double slope = 0.0;  // least squares over -2 .. 2 octaves
  for (int k = 0; k < 5; ++k) slope += (k - 2) * logs[static_cast<std::size_t>(k)] / 10.0;
  RecordProperty("slope", std::to_string(slope));
  EXPECT_NEAR(slope, -1.26, 0.15);
  for (std::size_t k = 1; k < logs.size(); ++k) EXPECT_LT(logs[k] - logs[k - 1], -0.7) << k;  // each octave
}

}  // namespace convergence_test
}  // namespace lagomorph::render
