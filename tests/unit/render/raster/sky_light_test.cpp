#include "render/raster/sky_light.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lagomorph::render::raster {
namespace sky_light_test {

constexpr double pi = std::numbers::pi;

/// A dim blue sky over brown land, with a bright patch at one side, 20 degrees wide or so.
Sky asymmetric_sky(int width = 256) {
  const int height = width / 2;
  std::vector<Color> texels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double u = (x + 0.5) / width, v = (y + 0.5) / height;
      texels.push_back(v < 0.5 ? Color(0.2F, 0.3F, 0.5F) : Color(0.2F, 0.12F, 0.06F));
      if (std::abs(u - 0.7) < 0.03 && std::abs(v - 0.3) < 0.06) texels.back() = Color(20.0F, 15.0F, 8.0F);
    }
  }
  Sky sky;
  sky.strength = 2.0F;
  sky.map = std::make_shared<const SkyMap>(width, height, std::move(texels), 35.0F);
  return sky;
}

/// What a function of the direction weighs of the sky's light, over all texels of the map.
template <class Weight>
Eigen::Array3d integral(const Sky& sky, const Weight& weight) {
  const SkyMap& map = *sky.map;
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (int y = 0; y < 4 * map.height(); ++y) {
    const double v = (y + 0.5) / (4 * map.height());
    const double angle = 2.0 * pi * pi * std::sin(pi * v) / (16.0 * map.width() * map.height());
    for (int x = 0; x < 4 * map.width(); ++x) {
      const Vec3 d = map.direction((x + 0.5) / (4 * map.width()), v);
      sum += angle * weight(d) * sky_radiance(sky, d).cast<double>();
    }
  }
  return sum;
}

/// The texel of a cube that a direction meets.
const Vec4& looked_up(const CubeMap<Vec4>& cube, const Vec3& direction) {
  const CubePlace p = cube_place(direction);
  const auto index = [&](float s) {
    return std::min(static_cast<int>(0.5F * (s + 1.0F) * static_cast<float>(cube.size())), cube.size() - 1);
  };
  return cube.at(p.face, index(p.s), index(p.t));
}

/// The middle of a texel.
Vec3 texel_direction(int size, int face, int x, int y) {
  const auto center = [size](int i) {
    return (2.0F * static_cast<float>(i) + 1.0F) / static_cast<float>(size) - 1.0F;
  };
  return cube_point(face, center(x), center(y)).normalized();
}

TEST(CubeMap, PlacesAndPointsAreInverse) {
  for (int face = 0; face < 6; ++face) {
    for (const auto& [s, t] : {std::pair{0.0F, 0.0F}, {0.5F, -0.25F}, {-0.9F, 0.7F}}) {
      const CubePlace p = cube_place(2.5F * cube_point(face, s, t));
      EXPECT_EQ(p.face, face);
      EXPECT_NEAR(p.s, s, 1e-6F);
      EXPECT_NEAR(p.t, t, 1e-6F);
    }
  }
}

TEST(CubeMap, TexelsShareTheSphere) {
  double sum = 0.0;
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) sum += 6.0 * cube_texel_solid_angle(8, x, y);
  }
  EXPECT_NEAR(sum, 4.0 * pi, 1e-12);
  // The one in the corner is seen from 3^(1/2) times as far and aslant.
  EXPECT_NEAR(cube_texel_solid_angle(512, 0, 0) / cube_texel_solid_angle(512, 256, 256), std::pow(3.0, -1.5),
              1e-2);
}

TEST(SkyLight, IrradianceIsTheMapsIntegral) {
  const Sky sky = asymmetric_sky();
  const SkyLight light = sky_light(sky);
  for (const int face : {0, 1, 2, 3, 4, 5}) {
    const int x = 3 + face, y = 12 - face;
    const Vec3 n = texel_direction(light.irradiance_above.size(), face, x, y);
    const auto cosine = [&](const Vec3& d) { return static_cast<double>(std::max(n.dot(d), 0.0F)); };
    const Eigen::Array3d above = integral(sky, [&](const Vec3& d) { return d.y() > 0.0F ? cosine(d) : 0.0; });
    const Eigen::Array3d below = integral(sky, [&](const Vec3& d) { return d.y() > 0.0F ? 0.0 : cosine(d); });
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(light.irradiance_above.at(face, x, y)[k], above[k], 0.005 * above[k] + 0.002) << face;
      const double seen_of_below = 0.5 * pi * (1.0 - static_cast<double>(n.y()));
      EXPECT_NEAR(light.radiance_below.at(face, x, y)[k] * seen_of_below, below[k], 0.005 * below[k] + 0.002)
          << face;
    }
  }
}

TEST(SkyLight, LobesOfAnEvenSkyAreItsRadiance) {
  Sky sky;
  sky.strength = 3.0F;
  sky.map = std::make_shared<const SkyMap>(16, 8, std::vector<Color>(128, Color(0.5F, 0.25F, 1.0F)));
  const SkyLight light = sky_light(sky);
  ASSERT_EQ(light.lobes_above.size(), static_cast<std::size_t>(sky_lobe_levels));
  for (int level = 0; level < sky_lobe_levels; ++level) {
    const auto& above = light.lobes_above[static_cast<std::size_t>(level)];
    const auto& below = light.lobes_below[static_cast<std::size_t>(level)];
    for (const Vec3& d :
         {Vec3(0, 1, 0), Vec3(0.6F, 0.1F, -0.5F), Vec3(-1, -0.05F, 0), Vec3(0.1F, -1, 0.1F)}) {
      const Vec4 up = looked_up(above, d), down = looked_up(below, d);
      EXPECT_LT((up + down - Vec4(1.5F, 0.75F, 3.0F, up[3] + down[3])).cwiseAbs().maxCoeff(), 1e-4F);
      EXPECT_NEAR(up[0], 1.5F * up[3], 1e-4F) << level;  // w is the part above
    }
    EXPECT_GT(looked_up(above, Vec3(0, 1, 0))[3], level < 3 ? 0.99F : 0.9F);
  }
}

TEST(SkyLight, RougherLobesAreWider) {
  const Sky sky = asymmetric_sky();
  const SkyLight light = sky_light(sky);
  const Vec3 patch = sky.map->direction(0.7, 0.3);
  // GGX's own mean over the sphere around the patch, normal along the view, by all texels.
  for (int level = 1; level < sky_lobe_levels; ++level) {
    const double a2 = std::pow(level / (sky_lobe_levels - 1.0), 4.0);
    const CubeMap<Vec4>& cube = light.lobes_above[static_cast<std::size_t>(level)];
    const CubePlace p = cube_place(patch);
    const int x = static_cast<int>(0.5F * (p.s + 1.0F) * static_cast<float>(cube.size()));
    const int y = static_cast<int>(0.5F * (p.t + 1.0F) * static_cast<float>(cube.size()));
    const Vec3 n = texel_direction(cube.size(), p.face, x, y);
    const auto lobe = [&](const Vec3& d) {
      const double nl = static_cast<double>(n.dot(d));
      if (nl <= 0.0) return 0.0;
      const double k =
          0.5 * (1.0 + nl) * (a2 - 1.0) + 1.0;  // the half vector's squared cosine is (1 + nl) / 2
      return nl * a2 / (k * k);
    };
    const double all = integral(
        Sky{.strength = 1.0F,
            .map = std::make_shared<const SkyMap>(256, 128, std::vector<Color>(256 * 128, Color::Ones()))},
        lobe)[0];
    const Eigen::Array3d mean =
        integral(sky, [&](const Vec3& d) { return d.y() > 0.0F ? lobe(d) : 0.0; }) / all;
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(cube.at(p.face, x, y)[k] / mean[k], 1.0, 0.04) << level;
  }
}

TEST(SkyLight, DirectionsShareTheLightAndOneLooksAtTheBrightPatch) {
  const Sky sky = asymmetric_sky();
  const SkyLight light = sky_light(sky);
  const Vec3 patch = sky.map->direction(0.7, 0.3);
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  float nearest = 2.0F;
  for (const SkyDirectionBlock& block : light.directions) {
    const Vec3 d = block.direction.head<3>(), right = block.right.head<3>(), up = block.up.head<3>();
    EXPECT_NEAR(d.norm(), 1.0F, 1e-5F);
    EXPECT_GT(d.y(), 0.0F);
    EXPECT_NEAR(right.norm(), 1.0F, 1e-5F);
    EXPECT_LT(std::abs(right.dot(d)) + std::abs(up.dot(d)) + std::abs(up.dot(right)), 1e-5F);
    sum += block.radiance.head<3>().array();
    nearest = std::min(nearest, (d - patch).norm());
  }
  EXPECT_LT(nearest, 0.12F);
  const Eigen::Array3d all = integral(sky, [](const Vec3& d) { return d.y() > 0.0F ? 1.0 : 0.0; });
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(sum[k], all[k], 0.01 * all[k]);
}

TEST(SkyLight, OfANightIsBlack) {
  Sky sky;
  sky.map = std::make_shared<const SkyMap>(8, 4, std::vector<Color>(32, Color::Zero()));
  const SkyLight light = sky_light(sky);
  for (const Vec4& texel : light.irradiance_above.texels()) EXPECT_TRUE(texel.head<3>().isZero());
  for (const SkyDirectionBlock& block : light.directions) {
    EXPECT_TRUE(block.radiance.isZero());
    EXPECT_TRUE(block.direction.allFinite());
  }
}

TEST(SkyLight, AReducedMapKeepsTheLight) {
  const Sky sky = asymmetric_sky(500);
  Sky small = sky;
  small.map = std::make_shared<const SkyMap>(reduced(*sky.map, 120));
  EXPECT_EQ(small.map->width(), 100);
  const auto even = [](const Vec3&) { return 1.0; };
  const Eigen::Array3d before = integral(sky, even), after = integral(small, even);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(after[k] / before[k], 1.0, 0.003);
  EXPECT_EQ(small.map->turn(), sky.map->turn());
  EXPECT_EQ(reduced(*sky.map, 500).width(), 500);
}

}  // namespace sky_light_test
}  // namespace lagomorph::render::raster
