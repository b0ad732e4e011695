#include "render/sky_map.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "render/error.h"

namespace lagomorph::render {
namespace sky_map_test {

/// Texel (x, y) has the value x + 100 y in red.
SkyMap numbered(int width, int height, float rotation = 0.0F) {
  std::vector<Color> texels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) texels.emplace_back(static_cast<float>(x + 100 * y), 0.0F, 0.0F);
  }
  return {width, height, texels, rotation};
}

TEST(SkyMap, DirectionsHaveTheirPlaces) {
  const SkyMap map = numbered(8, 4);
  EXPECT_LT((map.place(Vec3(0, 0, -1)) - Vec2(0.5F, 0.5F)).norm(), 1e-6F);
  EXPECT_LT((map.place(Vec3(1, 0, 0)) - Vec2(0.75F, 0.5F)).norm(), 1e-6F);
  EXPECT_LT((map.place(Vec3(-1, 0, 0)) - Vec2(0.25F, 0.5F)).norm(), 1e-6F);
  EXPECT_FLOAT_EQ(map.place(Vec3(0, 1, 0)).y(), 0.0F);
  EXPECT_FLOAT_EQ(map.place(Vec3(0, -1, 0)).y(), 1.0F);
  // Turned until the middle faces +x.
  EXPECT_LT((numbered(8, 4, 90.0F).place(Vec3(1, 0, 0)) - Vec2(0.5F, 0.5F)).norm(), 1e-6F);
}

TEST(SkyMap, PlacesAndDirectionsAreInverse) {
  for (const float rotation : {0.0F, 37.0F, -200.0F}) {
    const SkyMap map = numbered(8, 4, rotation);
    for (double v = 0.05; v < 1.0; v += 0.1) {
      for (double u = 0.01; u < 1.0; u += 0.07) {
        const Vec3 d = map.direction(u, v);
        EXPECT_NEAR(d.norm(), 1.0, 1e-6);
        const Vec2 at = map.place(d);
        EXPECT_NEAR(at.x(), u, 2e-6);
        EXPECT_NEAR(at.y(), v, 2e-6);
      }
    }
  }
}

TEST(SkyMap, IsBilinearBetweenCentresAndClosesAround) {
  const SkyMap map = numbered(8, 4);
  const auto red = [&](double x, double y) { return map.radiance(map.direction(x / 8.0, y / 4.0)).x(); };
  EXPECT_NEAR(red(2.5, 1.5), 102.0, 1e-3);
  EXPECT_NEAR(red(3.0, 1.5), 102.5, 1e-3);
  EXPECT_NEAR(red(3.25, 2.0), 152.75, 1e-3);
  EXPECT_NEAR(red(0.0, 1.5), 103.5, 1e-3);   // between texels 7 and 0
  EXPECT_NEAR(red(2.5, 0.1), 2.0, 1e-3);     // above the first row's centres
  EXPECT_NEAR(red(2.5, 3.95), 302.0, 1e-3);  // below the last row's
}

TEST(SkyMap, ErrorsNameTheTexel) {
  EXPECT_THROW(SkyMap(2, 2, {Color::Ones()}), SettingsError);
  std::vector<Color> texels(4, Color::Ones());
  texels[3] = Color(1.0F, -1.0F, 1.0F);
  try {
    SkyMap(2, 2, texels);
    FAIL();
  } catch (const SettingsError& e) {
    EXPECT_NE(std::string(e.what()).find("texel (1, 1)"), std::string::npos) << e.what();
  }
  texels[3] = Color::Constant(std::numeric_limits<float>::infinity());
  EXPECT_THROW(SkyMap(2, 2, texels), SettingsError);
}

}  // namespace sky_map_test
}  // namespace lagomorph::render
