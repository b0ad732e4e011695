#include "render/image_compare/light_noise.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "render/image_compare/student_t.h"

namespace lagomorph::render {
namespace light_noise_test {

/// 4 x 2 cells of a picture of 30 x 16 pixels, all alike.
LightStatistics statistics(float mean, float variance, float batches = 16, float samples = 16) {
  LightStatistics s{30, 16, {}};
  for (int cell = 0; cell < 8; ++cell)
    s.values.insert(s.values.end(), {mean, mean, mean, variance, variance, variance, batches, samples});
  return s;
}

TEST(LightNoise, ACellIsTestedAsWelchDoes) {
  const LightStatistics a = statistics(1, 1e-4F, 16, 16);
  LightStatistics b = statistics(1, 1e-4F, 8, 16);
  b.values[5 * 8 + 1] = 1.1F;
  const LightFigures figures = compare_light(a, b, {}, 0.01);
  const double sigma = std::sqrt(2e-4), dof = 4 / (1.0 / 15 + 1.0 / 7);
  EXPECT_NEAR(figures.cell_z, 0.1 / sigma, 1e-4);
  const double p = two_sided_p(0.1 / sigma, dof);
  EXPECT_NEAR(figures.false_discovery / (24 * p), 1, 1e-4);  // 8 cells of 3 channels
  EXPECT_EQ(figures.discoveries, 1);
  EXPECT_EQ(figures.cells, 8);
  EXPECT_EQ(figures.cell.x, 8);
  EXPECT_EQ(figures.cell.y, 8);
}

// With several off the k-th least p-value counts m / k times.
TEST(LightNoise, DiscoveriesAreHeldTogether) {
  const LightStatistics a = statistics(1, 1e-4F);
  LightStatistics b = a;
  for (std::size_t cell = 0; cell < 6; ++cell) b.values[cell * 8 + 2] = 1.06F;
  const LightFigures figures = compare_light(a, b, {}, 0.01);
  const double p = two_sided_p(0.06 / std::sqrt(2e-4), 30);
  EXPECT_NEAR(figures.false_discovery / (24.0 / 6 * p), 1, 1e-3);
  EXPECT_GT(24 * p, 0.002);  // alone it would not be one
  EXPECT_EQ(compare_light(a, b, {}, 0.002).discoveries, 6);
}

TEST(LightNoise, CellsAtTheBorderCountByTheirPixels) {
  const LightStatistics a = statistics(1, 1e-4F);
  LightStatistics b = a;
  for (std::size_t c = 0; c < 3; ++c) b.values[3 * 8 + c] = 2;  // 6 x 8 pixels
  const LightFigures figures = compare_light(a, b, {}, 0.01);
  EXPECT_NEAR(figures.global_change, 48.0 / (30 * 16), 1e-6);
  EXPECT_NEAR(figures.global_z, 48 / std::sqrt(2e-4 * (6 * 64 * 64 + 2 * 48 * 48)), 0.01);
  EXPECT_EQ(figures.cell.width, 6);
  EXPECT_GT(figures.cell_z, 0);
  EXPECT_LT(compare_light(b, a, {}, 0.01).cell_z, 0);
}

TEST(LightNoise, MaskedPixelsLeaveTheirCellsOut) {
  const LightStatistics a = statistics(1, 1e-4F);
  LightStatistics b = a;
  b.values[0] = 2;
  std::vector<std::uint8_t> mask(30 * 16);
  mask[7 * 30 + 7] = 1;
  const LightFigures figures = compare_light(a, b, mask, 0.01);
  EXPECT_EQ(figures.cells, 7);
  EXPECT_EQ(figures.false_discovery, 1);
  EXPECT_EQ(figures.global_z, 0);
}

TEST(LightNoise, RoundingIsNoOtherLight) {
  const LightStatistics a = statistics(1, 0);
  const LightFigures rounded = compare_light(a, statistics(1.000001F, 0), {}, 0.01);
  EXPECT_EQ(rounded.discoveries, 0);
  EXPECT_LT(rounded.global_z, 1);
  const LightFigures other = compare_light(a, statistics(1.001F, 0), {}, 0.01);
  EXPECT_EQ(other.discoveries, 8);
  EXPECT_GT(other.global_z, 50);
}

// 16 samples that all missed a sliver tell no variance; the 1024 that met it do.
TEST(LightNoise, FewSamplesMayHaveMissedWhatManyMet) {
  const LightStatistics many = statistics(1.001F, 1e-8F, 16, 1024), few = statistics(1, 0, 16, 16);
  EXPECT_NEAR(compare_light(many, few, {}, 0.01).cell_z, -0.001 / std::sqrt(1e-8 + 64e-8 + 1e-10), 1e-3);
}

TEST(LightNoise, OneSampleIsOfNoUse) {
  EXPECT_TRUE(statistics(1, 0).usable());
  EXPECT_FALSE(statistics(1, std::numeric_limits<float>::quiet_NaN()).usable());
  EXPECT_FALSE(statistics(std::numeric_limits<float>::infinity(), 0).usable());
}

}  // namespace light_noise_test
}  // namespace lagomorph::render
