#include "render/image_compare/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "render/error.h"
#include "render/image_compare/differences.h"
#include "render/image_compare/flip_color.h"
#include "render/image_compare/flip_tile.h"
#include "render/image_compare/pooling.h"
#include "tests/support/pictures.h"
#include "tests/support/slow_flip.h"

namespace lagomorph::render {
namespace flip_test {

using tests::bytes_of;
using tests::grainy;
using tests::SlowFlip;

void expect_slow(const Pixels& a, const Pixels& b, double ppd) {
  const ErrorMap map = flip_map(*linear_pair(a, b), ppd);
  const SlowFlip slow(a, b, ppd);
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x)
      ASSERT_NEAR(map.row(y)[x], slow.at(x, y), 5e-5) << x << "," << y << " at " << ppd;
  }
}

TEST(Flip, IsThePapersPixelByPixel) {
  expect_slow(grainy(45, 37, 1), grainy(45, 37, 2), default_pixels_per_degree);
  expect_slow(grainy(45, 37, 1), grainy(45, 37, 2), 20);
  expect_slow(grainy(31, 23, 3), grainy(31, 23, 4), 110);
  expect_slow(grainy(9, 7, 3), grainy(9, 7, 4), 1);
}

TEST(Flip, PicturesSmallerThanTheFilters) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 5}, {6, 1}, {3, 2}}) {
    expect_slow(grainy(width, height, 5), grainy(width, height, 6), default_pixels_per_degree);
  }
}

TEST(Flip, ALocalDifferenceInAFlatPicture) {
  Pixels a = grainy(40, 30, 1, 1);
  std::fill(bytes_of(a).begin(), bytes_of(a).end(), std::uint8_t{90});
  Pixels b = a;
  bytes_of(b)[3 * (15 * 40 + 20) + 1] = 250;
  expect_slow(a, b, default_pixels_per_degree);
}

TEST(Flip, SaturatedColours) {
  Pixels a = grainy(24, 20, 7);
  Pixels b = grainy(24, 20, 8);
  for (std::uint8_t& s : bytes_of(a)) s = s > 128 ? 255 : 0;
  for (std::uint8_t& s : bytes_of(b)) s = s > 100 ? 255 : 0;
  expect_slow(a, b, default_pixels_per_degree);
}

TEST(Flip, TheSameBitsForEveryNumberOfThreadsAndInstructionSet) {
  const Pixels a = grainy(1100, 150, 1);
  const Pixels b = grainy(1100, 150, 2);
  const auto pair = linear_pair(a, b);
  const auto with_threads = [&](std::size_t threads, InstructionSet set) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return flip_map(*pair, default_pixels_per_degree, set).values;
  };
  const std::vector<float> one = with_threads(1, InstructionSet::base);
  EXPECT_EQ(with_threads(4, InstructionSet::base), one);
  EXPECT_EQ(with_threads(1, widest_instruction_set()), one);
  EXPECT_EQ(with_threads(3, widest_instruction_set()), one);
}

TEST(Flip, APixelDoesNotDependOnItsTile) {
  const Pixels a = grainy(600, 140, 1);
  const Pixels b = grainy(600, 140, 2);
  const auto pair = linear_pair(a, b);
  const ErrorMap map = flip_map(*pair);
  const FlipFilters filters = flip_filters(default_pixels_per_degree);
  std::vector<float> scratch;
  for (const Tile& tile : {Tile{0, 0, 1, 1}, {290, 50, 37, 41}, {597, 130, 3, 10}, {0, 63, 600, 2}}) {
    std::vector<float> out(static_cast<std::size_t>(tile.width * tile.height));
    flip_tile(*pair, filters, tile, widest_instruction_set(), scratch, out.data(),
              static_cast<std::size_t>(tile.width));
    for (int y = 0; y < tile.height; ++y) {
      for (int x = 0; x < tile.width; ++x) {
        ASSERT_EQ(out[static_cast<std::size_t>(y * tile.width + x)], map.row(tile.y + y)[tile.x + x]);
      }
    }
  }
}

TEST(Flip, IsSymmetric) {
  const Pixels a = grainy(70, 50, 1);
  const Pixels b = grainy(70, 50, 2);
  EXPECT_EQ(flip_map(*linear_pair(a, b)).values, flip_map(*linear_pair(b, a)).values);
}

TEST(Flip, EqualPicturesAreZeroEverywhere) {
  const Pixels a = grainy(700, 90, 1);
  EXPECT_EQ(flip_map(*linear_pair(a, a)).values, std::vector<float>(700 * 90, 0.0F));
  // Also where the pictures differ elsewhere, further away than any filter reaches.
  Pixels b = a;
  bytes_of(b)[0] ^= 255U;
  const ErrorMap map = flip_map(*linear_pair(a, b));
  const int halo = static_cast<int>(flip_filters(default_pixels_per_degree).halo());
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (x <= halo && y <= halo) continue;
      ASSERT_EQ(map.row(y)[x], 0.0F) << x << "," << y;
    }
  }
  EXPECT_GT(map.values[0], 0.1F);
}

TEST(Flip, SixteenBitsAndAlphaChangeNothing) {
  const Pixels a = grainy(50, 40, 1);
  const Pixels b = grainy(50, 40, 2);
  const std::vector<float> expected = flip_map(*linear_pair(a, b)).values;
  const Pixels wide_a = widened(a);
  const Pixels wide_b = widened(b);
  EXPECT_EQ(flip_map(*linear_pair(wide_a, wide_b)).values, expected);
  Pixels with_alpha{.width = 50, .height = 40, .channels = 4, .alpha = true, .samples = {}};
  for (std::size_t i = 0; i < bytes_of(a).size(); i += 3) {
    for (std::size_t c = 0; c < 3; ++c) bytes_of(with_alpha).push_back(bytes_of(a)[i + c]);
    bytes_of(with_alpha).push_back(static_cast<std::uint8_t>(i % 256));
  }
  EXPECT_EQ(flip_map(*linear_pair(with_alpha, b)).values, expected);
  EXPECT_EQ(flip_map(*linear_pair(with_alpha, a)).values, std::vector<float>(2000, 0.0F));
}

TEST(FlipFilters, SumToOneAndDerivativesToOneAndMinusOne) {
  for (const double ppd : {1.0, 20.0, default_pixels_per_degree, 300.0, 1000.0}) {
    const FlipFilters f = flip_filters(ppd);
    const auto even_sum = [](const EvenFilter& w) {
      double sum = w[0];
      for (std::size_t k = 1; k < w.size(); ++k) sum += 2.0 * w[k];
      return sum;
    };
    EXPECT_NEAR(even_sum(f.y), 1, 1e-6) << ppd;
    EXPECT_NEAR(even_sum(f.cx), 1, 1e-6) << ppd;
    EXPECT_NEAR(std::pow(even_sum(f.cz_1), 2) + std::pow(even_sum(f.cz_2), 2), 1, 1e-6) << ppd;
    EXPECT_NEAR(even_sum(f.gauss), 1, 1e-6) << ppd;
    EXPECT_NEAR(even_sum(f.second), 0, 1e-6) << ppd;
    double first = 0;
    double second_positive = 0;
    for (std::size_t k = 1; k < f.first.size(); ++k) {
      first += f.first[k];
      if (f.second[k] > 0) second_positive += 2.0 * f.second[k];
    }
    EXPECT_NEAR(first, 1, 1e-6) << ppd;
    EXPECT_NEAR(second_positive, 1, 1e-6) << ppd;
  }
}

TEST(FlipFilters, RadiiOfTheDefault) {
  EXPECT_NEAR(default_pixels_per_degree, 67.0206, 1e-4);
  const FlipFilters f = flip_filters(default_pixels_per_degree);
  EXPECT_EQ(f.cz_1.size(), 11U);
  EXPECT_EQ(f.gauss.size(), 10U);
  EXPECT_EQ(f.halo(), 10U);
}

TEST(FlipFilters, RefuseWhatIsNoViewingDistance) {
  for (const double ppd : {0.0, -67.0, 0.99, 1000.1, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(flip_filters(ppd), SettingsError) << ppd;
  }
}

TEST(FlipColor, WhiteBlackAndTheLargestDistance) {
  const flip::Triple white = flip::hunt_lab({1, 1, 1});
  EXPECT_NEAR(white[0], 100, 1e-12);
  EXPECT_NEAR(white[1], 0, 1e-12);
  EXPECT_NEAR(white[2], 0, 1e-12);
  EXPECT_NEAR(flip::hunt_lab({0, 0, 0})[0], 0, 1e-12);
  // Y of the primaries [Rec. 709].
  EXPECT_NEAR(flip::relative_xyz_from_rgb()[1][0], 0.2126, 5e-5);
  EXPECT_NEAR(flip::relative_xyz_from_rgb()[1][1], 0.7152, 5e-5);
  EXPECT_NEAR(flip::relative_xyz_from_rgb()[1][2], 0.0722, 5e-5);
  const auto& forward = flip::relative_xyz_from_rgb();
  const flip::Triple back =
      flip::product(flip::rgb_from_relative_xyz(), flip::product(forward, {0.2, 0.5, 0.7}));
  EXPECT_NEAR(back[0], 0.2, 1e-14);
  EXPECT_NEAR(back[1], 0.5, 1e-14);
  EXPECT_NEAR(back[2], 0.7, 1e-14);
  const flip::Triple green = flip::hunt_lab(flip::product(forward, {0, 1, 0}));
  const flip::Triple blue = flip::hunt_lab(flip::product(forward, {0, 0, 1}));
  EXPECT_NEAR(flip::color_difference(green, blue), 1, 1e-14);
  EXPECT_NEAR(flip::largest_color_distance(), std::pow(flip::hyab(green, blue), 0.7), 1e-12);
  // The two branches meet at the knee.
  const double knee = std::pow(flip::knee_in * flip::largest_color_distance(), 1 / 0.7);
  EXPECT_NEAR(flip::color_difference({0, 0, 0}, {knee, 0, 0}), flip::knee_out, 1e-9);
  EXPECT_EQ(flip::color_difference({5, 6, 7}, {5, 6, 7}), 0);
}

}  // namespace flip_test
}  // namespace lagomorph::render
