#include "render/path/sky_sampler.h"

#include <cmath>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "render/backends.h"
#include "tests/unit/render/path/shapes.h"

namespace lagomorph::render::path {
namespace sky_sampler_test {

constexpr double pi = std::numbers::pi;

/// Dark but for some bright texels, with rows that are black.
SkyMap spotted(int width, int height) {
  std::vector<Color> texels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                            Color::Zero());
  for (std::size_t i = 0; i < texels.size(); i += 7)
    texels[i] = Color(1.0F, 2.0F, 0.5F) * static_cast<float>(1 + i % 5);
  for (std::size_t i = 0; i < static_cast<std::size_t>(3 * width); ++i) texels[i] = Color::Zero();
  texels[static_cast<std::size_t>(5 * width + 2)] = Color::Constant(900.0F);
  return {width, height, texels, 25.0F};
}

/// Integral over the sphere of g(direction).
template <class G>
double over_sphere(G g) {
  constexpr int n = 800;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double y = 1.0 - 2.0 * (i + 0.5) / n;
    const double across = std::sqrt(1.0 - y * y);
    for (int k = 0; k < 2 * n; ++k) {
      const double phi = pi * (k + 0.5) / n;
      sum += g(Vec3(static_cast<float>(across * std::cos(phi)), static_cast<float>(y),
                    static_cast<float>(across * std::sin(phi))));
    }
  }
  return sum * 4.0 * pi / (2.0 * n * n);
}

/// Over each texel it is constant.
TEST(SkySampler, ItsDensityIntegratesToOne) {
  const SkyMap map = spotted(16, 12);
  const SkySampler sampler(map);
  double sum = 0.0;
  for (int y = 0; y < 12; ++y) {
    const double band = std::cos(pi * y / 12.0) - std::cos(pi * (y + 1) / 12.0);
    for (int x = 0; x < 16; ++x) {
      const auto at = [&](double dx, double dy) {
        return static_cast<double>(sampler.pdf(map.direction((x + dx) / 16.0, (y + dy) / 12.0)));
      };
      EXPECT_FLOAT_EQ(static_cast<float>(at(0.1, 0.2)), static_cast<float>(at(0.9, 0.7)));
      sum += at(0.5, 0.5) * band * 2.0 * pi / 16.0;
    }
  }
  EXPECT_NEAR(sum, 1.0, 1e-6);
}

TEST(SkySampler, SamplesHaveItsDensityAndFindAllLight) {
  const SkyMap map = spotted(16, 12);
  const SkySampler sampler(map);
  constexpr int n = 1 << 16;
  const FrameSamples numbers(0, 0, n);
  Eigen::Array3d found = Eigen::Array3d::Zero();
  double upper = 0.0;
  for (int s = 0; s < n; ++s) {
    const SkySampler::Sample to = sampler.sample(numbers.path(0, 0, s).pair(0));
    ASSERT_NEAR(to.direction.norm(), 1.0, 1e-5);
    ASSERT_GT(to.pdf, 0.0F);
    // At a texel's border rounding may put the direction into its neighbour.
    found += map.radiance(to.direction).cast<double>() / static_cast<double>(to.pdf);
    upper += to.direction.x() > 0.3F ? 1.0 / n : 0.0;
  }
  found /= n;
  for (int k = 0; k < 3; ++k) {
    const double all = over_sphere([&](const Vec3& d) { return map.radiance(d)[k]; });
    EXPECT_NEAR(found[k], all, 5e-3 * all) << k;
  }
  EXPECT_NEAR(upper, over_sphere([&](const Vec3& d) { return d.x() > 0.3F ? sampler.pdf(d) : 0.0F; }), 5e-3);
}

TEST(SkySampler, WhereThereIsLightThereAreSamples) {
  const SkyMap map = spotted(16, 12);
  const SkySampler sampler(map);
  for (double v = 0.003; v < 1.0; v += 0.01) {
    for (double u = 0.003; u < 1.0; u += 0.01) {
      const Vec3 d = map.direction(u, v);
      if (map.radiance(d).maxCoeff() <= 0.0F) continue;
      ASSERT_GT(sampler.pdf(d), 0.0F) << u << " " << v;
    }
  }
}

TEST(SkySampler, ABlackMapHasNone) {
  const SkyMap black(4, 2, std::vector<Color>(8, Color::Zero()));
  EXPECT_EQ(SkySampler(black).sample({0.3F, 0.7F}).pdf, 0.0F);
}

/// Mean light of a diffuse floor of albedo 1/2 under a sky.
Color floor_under(const Sky& sky, const std::string& backend) {
  RenderScene scene;
  scene.ground.radius = 10.0F;
  scene.ground.fade_start = 9.0F;
  scene.ground.material = {Color::Constant(0.5F), 1.0F, 0.0F, 1.0F};
  scene.sky = sky;
  RenderSettings s;
  s.backend = backend;
  s.width = s.height = 8;
  s.samples = 256;
  s.path.bounces = 0;
  CameraSettings c;
  c.position = Vec3(0, 5.0F, 0);
  c.look_at = Vec3::Zero();
  c.up = Vec3(0, 0, -1);
  c.orthographic = 0.5F;
  const auto renderer = make_renderer(s, 2);
  renderer->set_scene(scene);
  const Image image = renderer->render(Camera(c, 8, 8), {});
  const std::vector<float>& values = image.find("color")->values;
  Color sum = Color::Zero();
  for (std::size_t i = 0; i < values.size(); i += 3) sum += Color(values[i], values[i + 1], values[i + 2]);
  return sum / 64.0F;
}

TEST(SkySampler, AFloorIsLitByTheMapsIrradiance) {
  Sky sky;
  sky.map = std::make_shared<const SkyMap>(spotted(64, 32));
  sky.strength = 0.1F;
  const Color path = floor_under(sky, "path");
  const Color raster = floor_under(sky, "raster");
  for (int k = 0; k < 3; ++k) {
    const double irradiance =
        over_sphere([&](const Vec3& d) { return std::max(d.y(), 0.0F) * sky.map->radiance(d)[k]; });
    const double expected = 0.5 / pi * 0.1 * irradiance;
    EXPECT_NEAR(path[k], expected, 5e-3 * expected) << k;
    EXPECT_NEAR(raster[k], expected, 0.02 * expected) << k;
  }
}

}  // namespace sky_sampler_test
}  // namespace lagomorph::render::path
