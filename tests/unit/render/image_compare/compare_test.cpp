#include "render/image_compare/compare.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "render/error.h"
#include "render/image_compare/flip.h"
#include "render/image_compare/ssim.h"
#include "tests/support/pictures.h"

namespace lagomorph::render {
namespace compare_test {

using tests::bytes_of;
using tests::grainy;

TEST(Compare, EqualPictures) {
  const Comparison c = compare_pictures(grainy(40, 30, 1), grainy(40, 30, 1));
  EXPECT_TRUE(c.figures.equal);
  EXPECT_TRUE(c.flip.values.empty());
  EXPECT_EQ(c.figures.flip_mean, 0);
  EXPECT_EQ(c.figures.flip_quartiles, (std::array<double, 3>{0, 0, 0}));
  EXPECT_EQ(c.figures.flip_tile.mean, 0);
  EXPECT_EQ(c.figures.ssim, 1);
  EXPECT_FALSE(c.figures.differences.psnr().has_value());
  EXPECT_EQ(c.figures.differences.root_mean_square(), 0);
  EXPECT_FALSE(c.figures.alpha.has_value());
}

TEST(Compare, FiguresOfEqualsAreThoseOfComparingThem) {
  for (const auto& [width, height] : {std::pair{40, 30}, {1, 1}, {11, 11}, {200, 10}}) {
    const Figures found = compare_pictures(grainy(width, height, 1), grainy(width, height, 1)).figures;
    const Figures said = figures_of_equals(width, height, false);
    EXPECT_EQ(found.equal, said.equal);
    EXPECT_EQ(found.ssim, said.ssim);
    EXPECT_EQ(found.flip_max, said.flip_max);
    EXPECT_EQ(found.differences.samples, said.differences.samples);
    EXPECT_EQ(found.flip_tile.tile.width, said.flip_tile.tile.width);
    EXPECT_EQ(said.differences.mean_absolute(), 0);
  }
  EXPECT_TRUE(figures_of_equals(3, 3, true).alpha.has_value());
}

TEST(Compare, FiguresAreThoseOfTheMetrics) {
  const Pixels a = grainy(70, 45, 1);
  const Pixels b = grainy(70, 45, 2);
  const Comparison c = compare_pictures(a, b, 30);
  const ErrorMap map = flip_map(*linear_pair(a, b), 30);
  EXPECT_EQ(c.flip.values, map.values);
  EXPECT_EQ(c.figures.flip_mean, mean(map));
  EXPECT_EQ(c.figures.flip_quartiles, weighted_quartiles(map));
  EXPECT_EQ(c.figures.flip_min, range(map).least);
  EXPECT_EQ(c.figures.flip_max, range(map).most);
  EXPECT_EQ(c.figures.flip_tile.mean, largest_tile_mean(map).mean);
  EXPECT_EQ(c.figures.ssim, ssim(a, b));
  EXPECT_EQ(c.figures.differences.sum, color_differences(a, b).sum);
}

TEST(Compare, AlphaAlone) {
  Pixels a{.width = 32,
           .height = 16,
           .channels = 4,
           .alpha = true,
           .samples = std::vector<std::uint8_t>(2048, 200)};
  Pixels b = a;
  for (std::size_t i = 16 * 4 + 3; i < 2048; i += 32 * 4) bytes_of(b)[i] = 0;
  const Figures f = compare_pictures(a, b).figures;
  EXPECT_TRUE(f.equal);
  ASSERT_TRUE(f.alpha.has_value());
  EXPECT_NEAR(f.alpha->most, 200.0 / 255, 1e-7);
  EXPECT_NEAR(f.alpha->mean, 200.0 / 255 / 32, 1e-7);
  EXPECT_NEAR(f.alpha->tile.mean, 200.0 / 255 / 16, 1e-7);
  EXPECT_EQ(f.alpha->tile.tile.x, 16);
}

TEST(Compare, EightBitsAgainstSixteen) {
  const Pixels a = grainy(30, 20, 1);
  EXPECT_TRUE(compare_pictures(a, widened(a)).figures.equal);
  Pixels b = widened(a);
  std::get<std::vector<std::uint16_t>>(b.samples)[7] ^= 1U;
  const Figures f = compare_pictures(a, b).figures;
  EXPECT_FALSE(f.equal);
  EXPECT_NEAR(f.differences.largest(), 1.0 / 65535, 1e-12);
}

TEST(Compare, RefusesOtherSizesAndDistances) {
  EXPECT_THROW(compare_pictures(grainy(30, 20, 1), grainy(20, 30, 1)), SettingsError);
  EXPECT_THROW(compare_pictures(grainy(5, 5, 1), grainy(5, 5, 1), 0), SettingsError);
}

}  // namespace compare_test
}  // namespace lagomorph::render
