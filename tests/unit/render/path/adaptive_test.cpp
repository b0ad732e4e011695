#include "render/path/adaptive.h"

#include <cmath>

#include <gtest/gtest.h>

#include "render/backends.h"
#include "render/channels.h"
#include "render/error.h"
#include "tests/unit/render/path/lit_sphere.h"

namespace lagomorph::render::path {
namespace adaptive_test {

/// Even sky above.
RenderScene scene_of_test() {
  RenderScene scene = lit_sphere();
  scene.background = Color::Constant(0.3F);
  return scene;
}

RenderSettings settings(int samples, float threshold) {
  RenderSettings s = lit_sphere_settings(samples);
  s.path.noise_threshold = threshold;
  s.path.min_samples = 16;
  s.channels = {"color", "sample_count"};
  return s;
}

Image draw(const RenderSettings& s, int threads = 2) { return draw_lit_sphere(scene_of_test(), s, threads); }

const std::vector<float>& values(const Image& image, const char* channel) {
  return image.find(channel)->values;
}

/// Root of the mean over the picture of |a - b|^2 / luminance, colours in the mean.
double noise(const Image& a, const Image& b) {
  const std::vector<float>& x = values(a, "color");
  const std::vector<float>& y = values(b, "color");
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double light = (static_cast<double>(y[i - i % 3]) + y[i - i % 3 + 1] + y[i - i % 3 + 2]) / 3.0;
    sum += std::pow(static_cast<double>(x[i]) - y[i], 2.0) / light;
  }
  return std::sqrt(sum / static_cast<double>(x.size()));
}

double mean(const std::vector<float>& of) {
  double sum = 0.0;
  for (const float v : of) sum += v;
  return sum / static_cast<double>(of.size());
}

TEST(Adaptive, NoiseIsWhatWasAskedForWithFewerSamples) {
  const Image exact = draw(settings(4096, 0.0F));
  for (const float threshold : {0.04F, 0.02F}) {
    const Image image = draw(settings(1024, threshold));
    const double left = noise(image, exact);
    EXPECT_LT(left, threshold) << threshold;
    EXPECT_GT(left, 0.1 * static_cast<double>(threshold));
    EXPECT_LT(mean(values(image, "sample_count")), 300.0) << threshold;
    EXPECT_NEAR(mean(values(image, "color")), mean(values(exact, "color")), 1e-3);
  }
}

TEST(Adaptive, EachSquareHasItsOwnCount) {
  const Image image = draw(settings(256, 0.02F));
  const std::vector<float>& counts = values(image, "sample_count");
  float least = counts[0], most = counts[0];
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 96; ++x) {
      const float n = counts[static_cast<std::size_t>(96 * y + x)];
      ASSERT_EQ(n, counts[static_cast<std::size_t>(96 * (y - y % 8) + x - x % 8)]);
      ASSERT_TRUE(n == 16 || n == 32 || n == 64 || n == 128 || n == 256) << n;
      least = std::min(least, n);
      most = std::max(most, n);
    }
  }
  EXPECT_EQ(least, 16.0F);
  EXPECT_GT(most, 32.0F);
}

TEST(Adaptive, ANoiseThatIsNeverReachedIsAllSamples) {
  // The same numbers, in another order of summation.
  const Image all = draw(settings(64, 0.0F));
  const Image adaptive = draw(settings(64, 1e-9F));
  const std::vector<float>& x = values(all, "color");
  const std::vector<float>& y = values(adaptive, "color");
  for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(x[i], y[i], 1e-5F * (1.0F + x[i]));
  EXPECT_EQ(mean(values(all, "sample_count")), 64.0);
  // The background has no noise at all.
  EXPECT_EQ(values(adaptive, "sample_count")[0], 16.0F);
}

TEST(Adaptive, SameBitsForAnyThreads) {
  const Image one = draw(settings(128, 0.02F), 1);
  const Image four = draw(settings(128, 0.02F), 4);
  EXPECT_EQ(values(one, "color"), values(four, "color"));
  EXPECT_EQ(values(one, "sample_count"), values(four, "sample_count"));
}

TEST(Adaptive, WhatCannotBeIsTold) {
  RenderSettings s = settings(16, 0.01F);
  s.path.min_samples = 0;
  EXPECT_THROW(make_path_renderer(s, 1), SettingsError);
  s = settings(16, -0.01F);
  EXPECT_THROW(make_path_renderer(s, 1), SettingsError);
  s = settings(16, 0.01F);
  s.channels = {"color", statistics_channel};
  EXPECT_THROW(make_path_renderer(s, 1), SettingsError);
}

}  // namespace adaptive_test
}  // namespace lagomorph::render::path
