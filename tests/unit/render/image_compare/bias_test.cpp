#include "render/image_compare/bias.h"

#include <gtest/gtest.h>

#include "tests/support/pictures.h"

namespace lagomorph::render {
namespace bias_test {

using tests::bytes_of;

Pixels flat(int width, int height, std::uint8_t value) {
  return {.width = width,
          .height = height,
          .samples = std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width * height), value)};
}

TEST(Bias, IsTheSignedMeanOfEachTile) {
  const Pixels a = flat(40, 20, 100);
  Pixels b = a;
  for (int x = 32; x < 40; ++x)
    bytes_of(b)[static_cast<std::size_t>(3 * (18 * 40 + x) + 1)] = 49;  // green, last tile
  const TileBias bias = tile_bias(a, b);
  ASSERT_EQ(bias.tiles.size(), 6U);
  EXPECT_FLOAT_EQ(bias.tiles[5][1], -51.0F / 255 * 8 / 32);
  EXPECT_EQ(bias.tiles[5][0], 0);
  EXPECT_EQ(bias.tiles[4][1], 0);
  const BiasFigures figures = bias_figures(bias);
  EXPECT_NEAR(figures.tile.mean, 0.2 * 8 / 32, 1e-7);
  EXPECT_EQ(figures.tile.tile.x, 32);
  EXPECT_EQ(figures.tile.tile.y, 16);
  EXPECT_EQ(figures.tile.tile.width, 8);
  EXPECT_EQ(figures.tile.tile.height, 4);
  EXPECT_NEAR(figures.mean, 0.2 * 8 / 800, 1e-8);
}

TEST(Bias, NoiseOfEitherSignAveragesOut) {
  const Pixels a = flat(16, 16, 100);
  Pixels b = a;
  for (std::size_t i = 0; i < bytes_of(b).size(); ++i) bytes_of(b)[i] = (i / 3) % 2 == 0 ? 130 : 70;
  EXPECT_EQ(bias_figures(tile_bias(a, b)).tile.mean, 0);
}

TEST(Bias, ChangesFromFrameToFrame) {
  const Pixels a = flat(16, 16, 100), up = flat(16, 16, 102), down = flat(16, 16, 97);
  const TileBias none{16, 16, {}};
  const auto change = [](const TileBias& before, const TileBias& now) {
    return bias_figures(change_of_bias(before, now)).tile.mean;
  };
  EXPECT_NEAR(change(tile_bias(a, up), tile_bias(a, down)), 5.0 / 255, 1e-7);
  EXPECT_EQ(change(tile_bias(a, up), tile_bias(a, up)), 0);
  EXPECT_NEAR(change(tile_bias(a, up), none), 2.0 / 255, 1e-7);
  EXPECT_NEAR(change(none, tile_bias(a, up)), 2.0 / 255, 1e-7);
  EXPECT_EQ(change(none, none), 0);
  EXPECT_TRUE(change_of_bias(TileBias{8, 8, {}}, none).tiles.empty());
}

TEST(Bias, OfSixteenBitsAndAlpha) {
  Pixels a{.width = 1,
           .height = 1,
           .channels = 4,
           .alpha = true,
           .samples = std::vector<std::uint16_t>{0, 0, 0, 9}};
  Pixels b = a;
  std::get<1>(b.samples) = {65535, 0, 0, 0};
  EXPECT_EQ(bias_figures(tile_bias(a, b)).mean, 1);
}

}  // namespace bias_test
}  // namespace lagomorph::render
