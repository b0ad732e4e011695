#include "render/atmosphere.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lagomorph::render {
namespace atmosphere_test {

constexpr double pi = std::numbers::pi;

/// Irradiance of the upper half on the ground.
Eigen::Array3d irradiance(const SkyMap& map) {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (int y = 0; y < map.height() / 2; ++y) {
    const double top = std::cos(pi * y / map.height());
    const double bottom = std::cos(pi * (y + 1) / map.height());
    for (int x = 0; x < map.width(); ++x) {
      sum += 2.0 * pi / map.width() * (top - bottom) * 0.5 * (top + bottom) * map.texel(x, y).cast<double>();
    }
  }
  return sum;
}

TEST(Atmosphere, SunlightIsWhatTheColumnLeaves) {
  // Straight up through exponential air and the tent of ozone, 15 km of its densest.
  const Sun sun = atmosphere_sun({.elevation = 90.0F, .azimuth = 0.0F, .turbidity = 1.0F});
  const double air = 8e3 * (1.0 - std::exp(-7.5));
  const double scattering[3] = {5.8e-6, 13.5e-6, 33.1e-6};
  const double absorption[3] = {0.650e-6, 1.881e-6, 0.085e-6};
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(sun.color[k], std::exp(-scattering[k] * air - absorption[k] * 15e3), 2e-3) << k;
  EXPECT_LT((sun.direction - Vec3(0, -1, 0)).norm(), 1e-6F);
}

TEST(Atmosphere, AllOrdersOfScatteringBringWhatEddingtonSays) {
  // Conservative isotropic slab of optical depth t under a sun overhead [Eddington's approximation]:
  //   T = ((2/3 + 1) + (2/3 - 1) exp(-t)) / (4/3 + t), and between it and a ground of albedo A
  //   T / (1 - A s), s = 1 - 1 / (1 + 3 t / 4). Scattered once only it would be 0.05 less.
  const Atmosphere clear{.elevation = 90.0F, .azimuth = 0.0F, .turbidity = 1.0F};
  const double t = 33.1e-6 * 8e3;
  const double through = (5.0 / 3.0 - std::exp(-t) / 3.0) / (4.0 / 3.0 + t);
  const double expected = through / (1.0 - 0.3 * (1.0 - 1.0 / (1.0 + 0.75 * t)));
  const double blue =
      irradiance(atmosphere_map(clear)).z() + static_cast<double>(atmosphere_sun(clear).color.z());
  EXPECT_NEAR(blue, expected, 0.02);
}

TEST(Atmosphere, TheSkyIsBlueAndAroundALowSunRed) {
  const Atmosphere noon{.elevation = 60.0F, .azimuth = 90.0F, .turbidity = 2.0F};
  const SkyMap day = atmosphere_map(noon);
  const Color up = day.radiance(Vec3(0, 1, 0));
  EXPECT_GT(up.z(), 1.5F * up.x());
  const Atmosphere evening{.elevation = 2.0F, .azimuth = 90.0F, .turbidity = 3.0F};
  const Sun sun = atmosphere_sun(evening);
  EXPECT_GT(sun.color.x(), 3.0F * sun.color.z());
  EXPECT_LT(sun.color.x(), atmosphere_sun(noon).color.x());
  // The azimuth of 90 degrees is +x, and haze scatters forwards.
  const SkyMap dusk = atmosphere_map(evening);
  const Color near = dusk.radiance(Vec3(1.0F, 0.05F, 0).normalized());
  const Color away = dusk.radiance(Vec3(-1.0F, 0.05F, 0).normalized());
  EXPECT_GT(near.x(), 2.0F * away.x());
  EXPECT_GT(near.x(), near.z());
  // After sunset there is some light in the sky, and none from the sun.
  const Atmosphere night{.elevation = -4.0F, .azimuth = 90.0F, .turbidity = 3.0F};
  EXPECT_EQ(atmosphere_sun(night).color.maxCoeff(), 0.0F);
  EXPECT_GT(atmosphere_map(night).radiance(Vec3(0, 1, 0)).z(), 0.0F);
  EXPECT_LT(atmosphere_map(night).radiance(Vec3(0, 1, 0)).z(), 0.05F * up.z());
}

}  // namespace atmosphere_test
}  // namespace lagomorph::render
