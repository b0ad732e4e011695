#include "render/raster/sky_sun.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "render/raster/sky_light.h"
#include "render/raster/stand_ins.h"
#include "tests/unit/render/raster/shapes.h"

namespace lagomorph::render::raster {
namespace sky_sun_test {

constexpr double degree = std::numbers::pi / 180.0;

/// Towards the sky, azimuth 0 is -z and 90 is +x.
Vec3 towards(double elevation, double azimuth) {
  const double e = elevation * degree, a = azimuth * degree;
  return Eigen::Vector3d(std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)).cast<float>();
}

struct BrightDisc {
  Vec3 direction;
  double angle;  // diameter [degrees]
  Color radiance;
};

/// Blue above and brown below with a glow around a disc; texels are means of 4 x 4 points.
Sky sky_with(const BrightDisc& disc, int width, float rotation = 0.0F) {
  const int height = width / 2;
  constexpr int points = 4;
  const SkyMap shape(1, 1, {Color::Zero()}, rotation);
  const double least = std::cos(0.5 * disc.angle * degree);
  std::vector<Color> texels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Color sum = Color::Zero();
      for (int k = 0; k < points * points; ++k) {
        const Vec3 d = shape.direction((x + (k % points + 0.5) / points) / width,
                                       (y + (k / points + 0.5) / points) / height);
        const float cosine = d.dot(disc.direction);
        sum += d.y() > 0.0F ? Color(0.3F, 0.45F, 0.7F) : Color(0.2F, 0.15F, 0.1F);
        sum += 0.3F * std::exp(8.0F * (cosine - 1.0F)) * Color(1.0F, 0.9F, 0.7F);
        if (static_cast<double>(cosine) > least) sum += disc.radiance;
      }
      texels.emplace_back(sum / static_cast<float>(points * points));
    }
  }
  Sky sky;
  sky.strength = 1.5F;
  sky.map = std::make_shared<const SkyMap>(width, height, std::move(texels), rotation);
  return sky;
}

/// Irradiance on a plane, of what a map has above the horizon.
Eigen::Array3d irradiance(const Sky& sky, const Vec3& normal) {
  const int rows = 4 * sky.map->height(), columns = 4 * sky.map->width();
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (int y = 0; y < rows / 2; ++y) {
    const double v = (y + 0.5) / rows;
    const double angle =
        2.0 * std::pow(std::numbers::pi, 2) * std::sin(std::numbers::pi * v) / rows / columns;
    for (int x = 0; x < columns; ++x) {
      const Vec3 d = sky.map->direction((x + 0.5) / columns, v);
      const float cosine = d.dot(normal);
      if (cosine > 0.0F) sum += angle * (cosine * sky_radiance(sky, d)).cast<double>();
    }
  }
  return sum;
}

/// The same of the sun, and of the rest as the rasterizer looks it up.
Eigen::Array3d irradiance_of_both(const SkySun& found, const SkyLight& light, const Vec3& normal) {
  const Sun& sun = found.sun;
  Color sum = sun.irradiance * std::max(-normal.dot(sun.direction), 0.0F) * sun.color;
  const CubePlace p = cube_place(normal);
  const int size = light.irradiance_above.size();
  const auto index = [&](float s) {
    return std::min(static_cast<int>(0.5F * (s + 1.0F) * static_cast<float>(size)), size - 1);
  };
  sum += light.irradiance_above.at(p.face, index(p.s), index(p.t)).head<3>().array();
  return sum.cast<double>();
}

void expect_all_light(const BrightDisc& disc, int width, float rotation) {
  const Sky sky = sky_with(disc, width, rotation);
  const std::optional<SkySun> found = sun_of_sky(sky);
  ASSERT_TRUE(found);
  EXPECT_GT(-found->sun.direction.dot(disc.direction), std::cos(0.1 * degree));
  // Texels are means over their squares, then tents: this much wider in their rows, and less across.
  const double texel = 360.0 / width, angle = static_cast<double>(found->sun.angle);
  EXPECT_GT(angle, disc.angle);
  EXPECT_LT(angle, std::sqrt(disc.angle * disc.angle + 4.0 * texel * texel) + 0.05);
  Sky rest = sky;
  rest.map = found->rest;
  const SkyLight light = sky_light(rest);
  // In the middles of the cube's texels, so that nothing is between them.
  const auto middle = [](int i) { return static_cast<float>(2 * i + 1) / 16.0F - 1.0F; };
  int count = 0;
  for (int face = 0; face < 6; ++face) {
    for (const auto& [i, j] : {std::pair{3, 8}, {12, 5}}) {
      const Vec3 normal = cube_point(face, middle(i), middle(j)).normalized();
      const Eigen::Array3d expected = irradiance(sky, normal);
      const Eigen::Array3d both = irradiance_of_both(*found, light, normal);
      if (-normal.dot(found->sun.direction) > 0.1F) ++count;
      // Where the sun sets on a plane its own width counts.
      if (std::abs(normal.dot(found->sun.direction)) < 0.03F) continue;
      EXPECT_LT(((both - expected) / expected).abs().maxCoeff(), 0.01) << normal.transpose();
    }
  }
  EXPECT_GE(count, 4);
}

TEST(SkySun, KeepsTheIrradianceOfPlanes) {
  expect_all_light({towards(35.0, 60.0), 2.0, Color(3000.0F, 2500.0F, 1800.0F)}, 512, 0.0F);
}
TEST(SkySun, KeepsTheIrradianceAcrossTheSeam) {
  expect_all_light({towards(25.0, 180.0), 2.0, Color(3000.0F, 2500.0F, 1800.0F)}, 512, 0.0F);
  expect_all_light({towards(50.0, -139.9), 4.0, Color(300.0F, 280.0F, 270.0F)}, 256, 40.0F);
}

/// A sun that no texel resolves is as wide as the tent that it is looked up as.
TEST(SkySun, IsAsWideAsItsTexels) {
  const std::optional<SkySun> found =
      sun_of_sky(sky_with({towards(20.0, 10.0), 0.5, Color::Constant(50000.0F)}, 256));
  ASSERT_TRUE(found);
  EXPECT_GT(found->sun.angle, 1.0F);
  EXPECT_LT(found->sun.angle, 2.8F);
}

TEST(SkySun, LeavesWhatSurroundsIt) {
  const Vec3 at = towards(35.0, 60.0);
  const Sky sky = sky_with({at, 3.0, Color::Constant(1000.0F)}, 512);
  const std::optional<SkySun> found = sun_of_sky(sky);
  ASSERT_TRUE(found);
  EXPECT_LT((found->rest->radiance(at) - Color(0.6F, 0.72F, 0.91F)).abs().maxCoeff(), 0.02F);
  for (const double beside : {4.0, 20.0, 180.0}) {
    const Vec3 d = towards(35.0, 60.0 + beside);
    EXPECT_EQ((found->rest->radiance(d) - sky.map->radiance(d)).abs().maxCoeff(), 0.0F) << beside;
  }
}

TEST(SkySun, IsSmallAndStrongAndAboveTheHorizon) {
  const Color bright = Color::Constant(2000.0F);
  const auto found = [](const BrightDisc& disc) { return sun_of_sky(sky_with(disc, 256)).has_value(); };
  EXPECT_TRUE(found({towards(30.0, 0.0), 3.0, bright}));
  EXPECT_TRUE(found({towards(90.0, 0.0), 3.0, bright}));
  EXPECT_FALSE(found({towards(30.0, 0.0), 3.0, Color::Zero()}));
  EXPECT_FALSE(found({towards(30.0, 0.0), 3.0, Color::Constant(20.0F)}));  // 3 % of the light
  EXPECT_FALSE(found({towards(30.0, 0.0), 25.0, bright}));
  EXPECT_FALSE(found({towards(1.0, 0.0), 3.0, bright}));
  EXPECT_FALSE(found({towards(-30.0, 0.0), 3.0, bright}));
  EXPECT_FALSE(sun_of_sky(Sky{}));
  Sky night = sky_with({towards(30.0, 0.0), 3.0, bright}, 64);
  night.map = std::make_shared<const SkyMap>(64, 32, std::vector<Color>(64 * 32, Color::Zero()));
  EXPECT_FALSE(sun_of_sky(night));
}

TEST(SkySun, IsNoStrip) {
  const auto found = [](int columns, int rows) {
    std::vector<Color> texels(256 * 128, Color(0.3F, 0.4F, 0.5F));
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x)
        texels[static_cast<std::size_t>((50 + y) * 256 + 100 + x)] = Color::Constant(500.0F);
    }
    Sky sky;
    sky.map = std::make_shared<const SkyMap>(256, 128, std::move(texels));
    return sun_of_sky(sky).has_value();
  };
  EXPECT_TRUE(found(4, 4));
  EXPECT_FALSE(found(8, 2));
  EXPECT_FALSE(found(2, 8));
}

TEST(SkySun, IsTheLastOfTheSunsThatAreDrawn) {
  RenderScene scene = empty_scene();
  scene.meshes = {box(Vec3(-0.1F, 0.0F, -0.1F), Vec3(0.1F, 0.2F, 0.1F))};
  scene.sky = sky_with({towards(30.0, 0.0), 3.0, Color::Constant(2000.0F)}, 512);
  scene.suns.resize(1);
  const RenderScene drawn = with_stand_ins(scene);
  ASSERT_EQ(drawn.suns.size(), 2U);
  EXPECT_EQ(drawn.lights.size(), 2U);
  EXPECT_FALSE(drawn.suns[1].visible);
  EXPECT_NE(drawn.sky.map, scene.sky.map);
  EXPECT_EQ(stand_in_remarks({}, scene).back(),
            "sky.image: its sun, 3.3 degrees wide, lights as a sun of its own");
  scene.suns.resize(4);
  scene.suns[2].irradiance = 0.1F;
  EXPECT_EQ(with_stand_ins(scene).suns.size(), 4U);
  EXPECT_NE(stand_in_remarks({}, scene).back().find("leaves out that of light 2;"), std::string::npos);
  // The weakest of five stays in the sky.
  for (Sun& sun : scene.suns) sun.irradiance = 100.0F;
  EXPECT_EQ(with_stand_ins(scene).sky.map, scene.sky.map);
  EXPECT_EQ(with_stand_ins(scene).suns.size(), 4U);
}

TEST(SkySun, IsSeenWhereItIs) {
  RenderScene scene = empty_scene();
  scene.background.reset();
  const Vec3 at = towards(20.0, 0.0);
  scene.sky = sky_with({at, 4.0, Color(300.0F, 200.0F, 100.0F)}, 256);
  CameraSettings camera;
  camera.position = Vec3::Zero();
  camera.look_at = at;
  const Image image = draw(scene, camera, small_settings(96, 64));
  const Color expected = sky_radiance(scene.sky, at), seen = color_at(image, 48, 32);
  EXPECT_LT(((seen - expected) / expected).abs().maxCoeff(), 0.01F);
}

}  // namespace sky_sun_test
}  // namespace lagomorph::render::raster
