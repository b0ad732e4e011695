#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "render/backends.h"
#include "render/error.h"
#include "render/image_compare/light_noise.h"
#include "tests/unit/render/path/shapes.h"

/// The channel tile_statistics, and what a test by it makes of seeds and of other light.
namespace lagomorph::render {
namespace tile_statistics_test {

RenderSettings settings(int width, int height, int samples, std::uint32_t seed = 0) {
  RenderSettings s;
  s.backend = "path";
  s.width = width;
  s.height = height;
  s.samples = samples;
  s.path.seed = seed;
  s.channels = {statistics_channel};
  return s;
}

/// A sphere on the ground between two lights; `brightness` times them, the sky and the background.
RenderScene lit_sphere(float brightness = 1.0F) {
  RenderScene scene;
  scene.meshes.push_back(make_sphere(2, 0.7F, Vec3(0, 0.7F, 0)));
  scene.lights.resize(2);
  scene.lights[1].position = Vec3(-2, 2, 1);
  scene.lights[1].color = Color(0.6F, 0.8F, 1.0F);
  for (AreaLight& light : scene.lights) light.radiance *= brightness;
  scene.sky.strength *= brightness;
  scene.background = Color(0.4F, 0.38F, 0.35F) * brightness;
  return scene;
}

Image draw(const RenderScene& scene, const RenderSettings& s, int threads = 2) {
  CameraSettings camera;
  camera.position = Vec3(0, 1.4F, 4);
  camera.look_at = Vec3(0, 0.6F, 0);
  const auto renderer = make_path_renderer(s, threads);
  renderer->set_scene(scene);
  return renderer->render(Camera(camera, s.width, s.height), {0, 0.0});
}

LightStatistics statistics(const RenderScene& scene, const RenderSettings& s) {
  return {s.width, s.height, draw(scene, s).find(statistics_channel)->values};
}

TEST(TileStatistics, MeansAreThoseOfThePicture) {
  for (const int samples : {2, 12, 48}) {
    const Image image = draw(lit_sphere(), settings(43, 37, samples));  // the last cells are 3 x 5
    const std::vector<float>& color = image.find("color")->values;
    const Channel& channel = *image.find(statistics_channel);
    ASSERT_EQ(channel.width, 6);
    ASSERT_EQ(channel.height, 5);
    ASSERT_EQ(channel.values.size(), 6U * 5 * statistics_components);
    for (int cell = 0; cell < 30; ++cell) {
      const int x0 = cell % 6 * 8, y0 = cell / 6 * 8, x1 = std::min(x0 + 8, 43), y1 = std::min(y0 + 8, 37);
      const float* values = channel.values.data() + cell * statistics_components;
      for (int k = 0; k < 3; ++k) {
        double sum = 0;
        for (int y = y0; y < y1; ++y) {
          for (int x = x0; x < x1; ++x) sum += color[static_cast<std::size_t>(3 * (y * 43 + x) + k)];
        }
        EXPECT_NEAR(values[k], sum / ((x1 - x0) * (y1 - y0)), 2e-6 * values[k]) << cell;
        EXPECT_GE(values[3 + k], 0) << cell;
      }
      EXPECT_EQ(values[6], std::min(samples, 16));
      EXPECT_EQ(values[7], samples);
    }
  }
}

TEST(TileStatistics, ThePictureIsTheSameWithAndWithout) {
  RenderSettings s = settings(40, 24, 6);
  const std::vector<float> with = draw(lit_sphere(), s).find("color")->values;
  s.channels.clear();
  EXPECT_EQ(draw(lit_sphere(), s).find("color")->values, with);
}

TEST(TileStatistics, SameBitsForAnyThreads) {
  const RenderSettings s = settings(70, 41, 10);
  const std::vector<float> two = draw(lit_sphere(), s, 2).find(statistics_channel)->values;
  EXPECT_EQ(draw(lit_sphere(), s, 1).find(statistics_channel)->values, two);
  EXPECT_EQ(draw(lit_sphere(), s, 3).find(statistics_channel)->values, two);
}

TEST(TileStatistics, OneSampleHasNoVariance) {
  EXPECT_FALSE(statistics(lit_sphere(), settings(16, 16, 1)).usable());
  EXPECT_TRUE(statistics(lit_sphere(), settings(16, 16, 2)).usable());
}

// Over the seeds, the variance told is that of the means or larger; and not beyond use.
TEST(TileStatistics, VarianceIsTheTrueOneOrLarger) {
  constexpr int seeds = 24;
  std::vector<LightStatistics> all;
  for (std::uint32_t seed = 0; seed < seeds; ++seed)
    all.push_back(statistics(lit_sphere(), settings(48, 32, 16, seed)));
  double truth = 0, told = 0;
  int cells_too_low = 0;
  for (std::size_t cell = 0; cell < 24; ++cell) {
    double mean = 0, true_variance = 0, variance = 0;
    for (const LightStatistics& s : all) {
      mean += 1.0 * s.values[cell * statistics_components] / seeds;
      variance += 1.0 * s.values[cell * statistics_components + 3] / seeds;
    }
    for (const LightStatistics& s : all) {
      const double off = s.values[cell * statistics_components] - mean;
      true_variance += off * off / (seeds - 1);
    }
    truth += true_variance;
    told += variance;
    if (true_variance > 2 * variance + 1e-20) ++cells_too_low;  // 24 seeds know it to some 30 %
  }
  EXPECT_EQ(cells_too_low, 0);
  EXPECT_GE(told, truth);
  EXPECT_LE(told, 30 * truth);
}

TEST(TileStatistics, SeedsAloneAreNoOtherLight) {
  std::vector<LightStatistics> all;
  for (std::uint32_t seed = 0; seed < 16; ++seed)
    all.push_back(statistics(lit_sphere(), settings(48, 32, seed < 12 ? 16 : 64, seed)));
  for (std::size_t a = 0; a < all.size(); ++a) {
    for (std::size_t b = a + 1; b < all.size(); ++b) {
      const LightFigures figures = compare_light(all[a], all[b], {}, 0.001);
      EXPECT_EQ(figures.discoveries, 0) << a << " " << b << ": z " << figures.cell_z;
      EXPECT_LT(std::abs(figures.global_z), 5) << a << " " << b;
    }
  }
}

// At 1024 samples and 320x180 pixels: tests/full/monte_carlo.sh.
TEST(TileStatistics, HalfAPercentIsSeenAtSixteenSamplesAgainstManyMore) {
  const LightStatistics golden = statistics(lit_sphere(), settings(128, 96, 256, 100));
  for (std::uint32_t seed = 0; seed < 2; ++seed) {
    const RenderSettings few = settings(128, 96, 16, seed);
    const LightFigures same = compare_light(golden, statistics(lit_sphere(), few), {}, 0.001);
    EXPECT_EQ(same.discoveries, 0) << seed;
    EXPECT_LT(std::abs(same.global_z), 3) << seed;
    const LightFigures brighter = compare_light(golden, statistics(lit_sphere(1.005F), few), {}, 0.001);
    EXPECT_GT(brighter.global_z, 5) << seed;
    EXPECT_NEAR(brighter.global_change, 0.005, 0.001) << seed;
  }
}

TEST(TileStatistics, OnlyThePathTracerHasThem) {
  RenderSettings s = settings(16, 16, 4);
  s.backend = "raster";
  try {
    make_renderer(s, 1);
    FAIL();
  } catch (const SettingsError& error) {
    EXPECT_STREQ(error.what(),
                 "render.channels: 'tile_statistics' is drawn by render.backend = \"path\" only");
  }
}

}  // namespace tile_statistics_test
}  // namespace lagomorph::render
