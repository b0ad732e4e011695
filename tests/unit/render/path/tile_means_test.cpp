#include "render/path/tile_means.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "render/backends.h"
#include "render/channels.h"
#include "render/error.h"
#include "tests/unit/render/path/shapes.h"

/// The channels that denoisers need.
namespace lagomorph::render {
namespace tile_means_test {

using path::BatchedMean;

const std::vector<std::string> all = {variance_channel, denoising_albedo_channel, denoising_normal_channel,
                                      denoising_depth_channel};

RenderSettings settings(int samples, std::uint32_t seed = 0) {
  RenderSettings s;
  s.backend = "path";
  s.width = 48;
  s.height = 32;
  s.samples = samples;
  s.path.seed = seed;
  s.path.bounces = 1;
  s.path.filter = "box";
  s.path.filter_radius = 0.5F;
  s.channels = all;
  return s;
}

/// A wall of the upper left quarter of an orthographic view 3 m wide and 2 m high, 4 m away; its right edge
/// is at 0.4 of a pixel.
RenderScene wall() {
  RenderScene scene;
  scene.ground.enabled = false;
  scene.meshes = {make_quad(Vec3(-3, 0, 0), Vec3(3.025F, 0, 0), Vec3(0, 3, 0))};
  scene.meshes[0].material.base_color = Color(0.2F, 0.5F, 0.8F);
  scene.lights.resize(1);
  return scene;
}

CameraSettings wall_camera() {
  CameraSettings c;
  c.position = Vec3(0, 0, 4);
  c.look_at = Vec3::Zero();
  c.orthographic = 2.0F;
  return c;
}

RenderScene sphere_on_ground() {
  RenderScene scene;
  scene.meshes = {make_sphere(3, 0.7F, Vec3(0, 0.7F, 0))};
  scene.lights.resize(1);
  return scene;
}

CameraSettings sphere_camera() {
  CameraSettings c;
  c.position = Vec3(0, 1.4F, 4);
  c.look_at = Vec3(0, 0.6F, 0);
  return c;
}

Image draw(const RenderScene& scene, const CameraSettings& camera, const RenderSettings& s, int threads = 2) {
  const auto renderer = make_path_renderer(s, threads);
  renderer->set_scene(scene);
  return renderer->render(Camera(camera, s.width, s.height), {});
}

Color at(const Image& image, const char* channel, int x, int y) {
  const float* v = image.find(channel)->values.data() + 3 * (y * image.width() + x);
  return {v[0], v[1], v[2]};
}
float value_at(const Image& image, const char* channel, int x, int y) {
  return image.find(channel)->values[static_cast<std::size_t>(y * image.width() + x)];
}

TEST(BatchedMean, IsTheVarianceBetweenBatches) {
  const auto variance = [](int samples) {
    BatchedMean mean;
    for (int i = 1; i <= samples; ++i)
      mean.add(Color(static_cast<float>(i), static_cast<float>(i * i), 1.0F));
    return mean.variance();
  };
  EXPECT_TRUE(variance(1).isNaN().all());
  EXPECT_DOUBLE_EQ(variance(2)[0], 0.25);              // 1, 2
  EXPECT_DOUBLE_EQ(variance(8)[0], 42.0 / (8 * 7));    // 1 ... 8
  EXPECT_DOUBLE_EQ(variance(16)[0], 168.0 / (8 * 7));  // 1.5, 3.5, ... 15.5
  // 1.5, 3.5, 5.5, 7.5 of two each and 9 of one; the mean is 5.
  EXPECT_NEAR(variance(9)[0], (2 * (3.5 * 3.5 + 1.5 * 1.5 + 0.5 * 0.5 + 2.5 * 2.5) + 16.0) / 9 / 4, 1e-12);
  EXPECT_EQ(variance(9)[2], 0.0);
}

TEST(DenoisingChannels, AreMeansOverThePixel) {
  const Image image = draw(wall(), wall_camera(), settings(256));
  const auto albedo = [&](int x, int y) { return at(image, denoising_albedo_channel, x, y); };
  const auto normal = [&](int x, int y) { return at(image, denoising_normal_channel, x, y); };
  const auto depth = [&](int x, int y) { return value_at(image, denoising_depth_channel, x, y); };
  EXPECT_TRUE(albedo(10, 5).isApprox(Color(0.2F, 0.5F, 0.8F)));
  EXPECT_TRUE(normal(10, 5).isApprox(Color(0, 0, 1)));
  EXPECT_NEAR(depth(10, 5), 4.0F, 1e-6F);
  // 0.4 of the pixel right of the middle sees the wall.
  EXPECT_NEAR(albedo(24, 5)[1], 0.4F * 0.5F, 0.01F);
  EXPECT_NEAR(normal(24, 5)[2], 0.4F, 0.02F);
  EXPECT_NEAR(depth(24, 5), 4.0F, 1e-6F);
  EXPECT_TRUE((albedo(30, 5) == 0.0F).all() && (normal(30, 5) == 0.0F).all());
  EXPECT_EQ(depth(30, 5), std::numeric_limits<float>::infinity());
  EXPECT_TRUE((at(image, variance_channel, 24, 5) > 0.0F).all());
}

TEST(DenoisingChannels, AlbedoIsWhatTheSurfaceShows) {
  RenderScene scene = wall();
  scene.meshes[0].material.metallic = 1.0F;
  const auto seen = [&] {
    return at(draw(scene, wall_camera(), settings(4)), denoising_albedo_channel, 10, 5);
  };
  EXPECT_TRUE(seen().isApprox(Color(0.2F, 0.5F, 0.8F)));  // a metal's reflectance
  scene.meshes[0].material.metallic = 0.0F;
  scene.meshes[0].material.subsurface = 1.0F;
  scene.meshes[0].material.subsurface_color = Color(0.9F, 0.4F, 0.1F);
  EXPECT_TRUE(seen().isApprox(Color(0.9F, 0.4F, 0.1F)));
  scene.meshes[0].material.subsurface = 0.0F;
  scene.meshes[0].colors.assign(4, Color(0.1F, 0.6F, 0.3F));
  EXPECT_TRUE(seen().isApprox(Color(0.1F, 0.6F, 0.3F)));
}

TEST(DenoisingChannels, TheGroundWeighsAsItIsOpaque) {
  RenderScene scene;
  scene.ground.radius = 4.0F;
  scene.ground.fade_start = 1.0F;
  CameraSettings down;
  down.position = Vec3(0, 5, 0);
  down.look_at = Vec3::Zero();
  down.up = Vec3(0, 0, -1);
  down.orthographic = 10.0F;
  const Image image = draw(scene, down, settings(64));
  for (int x = 0; x < 48; ++x) {
    const Vec3 p((static_cast<float>(x) + 0.5F) / 48 * 15 - 7.5F, 0, 10.0F / 64);
    const float opacity = 1.0F - ground_fade(scene.ground, p);
    EXPECT_NEAR(at(image, denoising_albedo_channel, x, 16)[0], 0.55F * opacity, 0.01F) << x;
    EXPECT_NEAR(at(image, denoising_normal_channel, x, 16)[1], opacity, 0.02F) << x;
  }
  EXPECT_NEAR(value_at(image, denoising_depth_channel, 24, 16), 5.0F, 1e-5F);
}

TEST(DenoisingChannels, LeaveThePictureAsItIsForAnyThreads) {
  RenderSettings s = settings(12);
  const Image one = draw(sphere_on_ground(), sphere_camera(), s, 1);
  const Image three = draw(sphere_on_ground(), sphere_camera(), s, 3);
  for (const std::string& channel : all)
    EXPECT_EQ(one.find(channel)->values, three.find(channel)->values) << channel;
  s.channels.clear();
  EXPECT_EQ(draw(sphere_on_ground(), sphere_camera(), s).find("color")->values, one.find("color")->values);
}

TEST(DenoisingChannels, AdaptiveSamplingGivesThemToo) {
  RenderSettings s = settings(64);
  const Image even = draw(sphere_on_ground(), sphere_camera(), s);
  s.path.noise_threshold = 1e-9F;  // never reached but where there is no noise
  s.path.min_samples = 64;
  const Image adaptive = draw(sphere_on_ground(), sphere_camera(), s);
  for (const std::string& channel : all) {
    const std::vector<float>&a = even.find(channel)->values, &b = adaptive.find(channel)->values;
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(a, b) << channel;
  }
}

TEST(DenoisingChannels, VarianceIsThatOfOtherSeedsOrSomewhatMore) {
  constexpr int seeds = 32;
  std::vector<double> sum, squares;
  double told = 0.0;
  for (int seed = 0; seed < seeds; ++seed) {
    const Image image =
        draw(sphere_on_ground(), sphere_camera(), settings(64, static_cast<std::uint32_t>(seed)));
    const std::vector<float>& color = image.find("color")->values;
    sum.resize(color.size());
    squares.resize(color.size());
    for (std::size_t i = 0; i < color.size(); ++i) {
      sum[i] += static_cast<double>(color[i]);
      squares[i] += static_cast<double>(color[i]) * static_cast<double>(color[i]);
    }
    for (const float v : image.find(variance_channel)->values) told += static_cast<double>(v) / seeds;
  }
  double seen = 0.0;
  for (std::size_t i = 0; i < sum.size(); ++i) seen += (squares[i] - sum[i] * sum[i] / seeds) / (seeds - 1);
  RecordProperty("told_over_seen", std::to_string(told / seen));
  EXPECT_GT(told / seen, 0.9);
  EXPECT_LT(told / seen, 3.0);
}

TEST(DenoisingChannels, AreThePathTracersOnly) {
  for (const std::string& channel : all) {
    RenderSettings s;
    s.channels = {channel};
    EXPECT_THROW(make_renderer(s, 1), SettingsError);
  }
}

}  // namespace tile_means_test
}  // namespace lagomorph::render
