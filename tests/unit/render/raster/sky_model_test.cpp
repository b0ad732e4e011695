#include "render/raster/sky_model.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lagomorph::render::raster {
namespace sky_model_test {

constexpr double pi = std::numbers::pi;

TEST(SkyModel, IrradianceIsTheIntegralOverTheHemisphere) {
  for (const double ny : {-1.0, -0.7, 0.0, 0.3, 1.0}) {
    const double nx = std::sqrt(1.0 - ny * ny);
    double horizon = 0.0;
    double zenith = 0.0;
    constexpr int steps = 1000;
    for (int i = 0; i < steps; ++i) {
      const double y = (i + 0.5) / steps;
      for (int k = 0; k < steps; ++k) {
        const double phi = 2.0 * pi * (k + 0.5) / steps;
        const double cosine = std::max(nx * std::sqrt(1.0 - y * y) * std::cos(phi) + ny * y, 0.0);
        const double solid_angle = 2.0 * pi / (steps * steps);
        horizon += (1.0 - std::sqrt(y)) * cosine * solid_angle;
        zenith += std::sqrt(y) * cosine * solid_angle;
      }
    }
    const SkyIrradiance e = sky_irradiance(static_cast<float>(ny));
    EXPECT_NEAR(e.horizon, horizon, 2e-4) << ny;
    EXPECT_NEAR(e.zenith, zenith, 2e-4) << ny;
  }
}

TEST(SkyModel, TableRunsFromBelowToAbove) {
  const std::vector<SkyIrradiance> table = sky_irradiance_table(5);
  ASSERT_EQ(table.size(), 5U);
  EXPECT_NEAR(table[0].horizon + table[0].zenith, 0.0F, 1e-6F);
  EXPECT_NEAR(table[2].horizon, sky_irradiance(0.0F).horizon, 1e-6F);
  EXPECT_NEAR(table[4].horizon + table[4].zenith, pi, 1e-5);
  EXPECT_NEAR(table[4].zenith, 0.8 * pi, 1e-5);  // 2 pi times the integral of y sqrt(y)
}

/// The coat's reflectance by plain quadrature over the directions of light, with f0 = 1 - f90 (the two
/// parts).
CoatAlbedo quadrature(double cos_view, double roughness) {
  const double a2 = std::pow(roughness, 4.0);
  const double vx = std::sqrt(1.0 - cos_view * cos_view);
  CoatAlbedo sum{0.0F, 0.0F};
  constexpr int steps = 900;
  double scale = 0.0;
  double offset = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double lz = (i + 0.5) / steps;
    const double r = std::sqrt(1.0 - lz * lz);
    for (int k = 0; k < steps; ++k) {
      const double phi = pi * (k + 0.5) / steps;  // the other half is the same
      double hx = r * std::cos(phi) + vx;
      double hy = r * std::sin(phi);
      double hz = lz + cos_view;
      const double length = std::sqrt(hx * hx + hy * hy + hz * hz);
      hx /= length, hy /= length, hz /= length;
      const double d = a2 / (pi * std::pow(hz * hz * (a2 - 1.0) + 1.0, 2.0));
      const double v = 0.5 / (lz * std::sqrt(a2 + (1.0 - a2) * cos_view * cos_view) +
                              cos_view * std::sqrt(a2 + (1.0 - a2) * lz * lz));
      const double fresnel = std::pow(1.0 - (hx * vx + hz * cos_view), 5.0);
      const double weight = d * v * lz * 2.0 * pi / (steps * steps);
      scale += weight * (1.0 - fresnel);
      offset += weight * fresnel;
    }
  }
  sum.scale = static_cast<float>(scale);
  sum.offset = static_cast<float>(offset);
  return sum;
}

TEST(SkyModel, CoatAlbedoIsTheIntegralOfItsBrdf) {
  for (const float roughness : {0.35F, 0.6F, 1.0F}) {
    for (const float cosine : {0.1F, 0.5F, 0.98F}) {
      const CoatAlbedo a = coat_albedo(cosine, roughness);
      const CoatAlbedo b = quadrature(cosine, roughness);
      EXPECT_NEAR(a.scale, b.scale, 4e-3F) << cosine << " " << roughness;
      EXPECT_NEAR(a.offset, b.offset, 4e-3F) << cosine << " " << roughness;
    }
  }
}

TEST(SkyModel, AMirrorReflectsAll) {
  const CoatAlbedo a = coat_albedo(0.7F, 0.0F);
  EXPECT_NEAR(a.scale + a.offset, 1.0F, 1e-3F);
  EXPECT_NEAR(a.offset, std::pow(0.3F, 5.0F), 1e-4F);
}

TEST(SkyModel, DirectionsShareTheHemisphere) {
  const auto directions = sky_directions(Sky{});
  Vec3 mean = Vec3::Zero();
  for (const SkyDirectionBlock& d : directions) {
    const Vec3 right = d.right.head<3>();
    const Vec3 up = d.up.head<3>();
    const Vec3 to_sky = d.direction.head<3>();
    EXPECT_NEAR(right.cross(up).dot(to_sky), 1.0F, 1e-5F);
    EXPECT_NEAR(to_sky.norm(), 1.0F, 1e-5F);
    EXPECT_GT(to_sky.y(), 0.0F);
    EXPECT_NEAR(d.radiance[0], sky_radiance(Sky{}, to_sky)[0], 1e-6F);
    mean += to_sky / static_cast<float>(directions.size());
  }
  EXPECT_NEAR((mean - Vec3(0.0F, 0.5F, 0.0F)).norm(), 0.0F, 0.06F);  // the centroid of a hemisphere
}

}  // namespace sky_model_test
}  // namespace lagomorph::render::raster
