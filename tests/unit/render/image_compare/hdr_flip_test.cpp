#include "render/image_compare/hdr_flip.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "render/error.h"
#include "render/image_compare/pooling.h"
#include "tests/support/slow_flip.h"

namespace lagomorph::render {
namespace hdr_flip_test {

/// Light of many magnitudes, smooth with some grain.
FloatPicture lights(int width, int height, std::uint32_t seed) {
  FloatPicture picture{width, height, {}};
  std::mt19937 random(seed);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double base = std::exp2(6.0 * x / width - 3.0);
      for (int c = 0; c < 3; ++c)
        picture.rgb.push_back(static_cast<float>(base * (0.7 + 0.1 * c + (random() % 1000) * 2e-4)));
    }
  }
  return picture;
}

/// The paper's words in double, a pixel at a time.
double slow_aces(double x) {
  x *= 0.6;
  return std::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

/// The light whose tone is 0.85, by bisection.
double light_of_tone() {
  double low = 0, high = 100;
  for (int i = 0; i < 200; ++i) (slow_aces((low + high) / 2) < 0.85 ? low : high) = (low + high) / 2;
  return low;
}

std::vector<double> exposed(const FloatPicture& picture, double stops) {
  std::vector<double> values;
  for (const float v : picture.rgb) values.push_back(slow_aces(v * std::exp2(stops)));
  return values;
}

TEST(HdrFlip, ExposuresAreThePapers) {
  FloatPicture picture{2, 2, {}};
  for (const float y : {0.5F, 8.0F, 2.0F, 4.0F}) picture.rgb.insert(picture.rgb.end(), {y, y, y});
  const ExposureRange range = exposure_range(picture);
  EXPECT_NEAR(range.start, std::log2(light_of_tone() / 8), 1e-6);
  EXPECT_NEAR(range.stop, std::log2(light_of_tone() / 3), 1e-6);  // the median of four: 3
  EXPECT_EQ(range.count, 2);
  picture.rgb[3] = picture.rgb[4] = picture.rgb[5] = 800;
  EXPECT_EQ(exposure_range(picture).count, 9);  // log2(800 / 3) = 8.06
  EXPECT_DOUBLE_EQ(exposure_range(picture).at(8), exposure_range(picture).stop);
}

TEST(HdrFlip, IsTheLargestOfAllExposuresPixelByPixel) {
  const FloatPicture a = lights(33, 21, 1), b = lights(33, 21, 2);
  const HdrFlip fast = hdr_flip(a, b, 40);
  ASSERT_GE(fast.exposures.count, 3);
  std::vector<double> most(33 * 21);
  for (int i = 0; i < fast.exposures.count; ++i) {
    const double stops = fast.exposures.at(i);
    const tests::SlowFlip slow(33, 21, exposed(a, stops), exposed(b, stops), 40);
    for (int y = 0; y < 21; ++y) {
      for (int x = 0; x < 33; ++x) {
        double& m = most[static_cast<std::size_t>(y * 33 + x)];
        m = std::max(m, slow.at(x, y));
      }
    }
  }
  for (std::size_t k = 0; k < most.size(); ++k) ASSERT_NEAR(fast.map.values[k], most[k], 1e-4) << k;
}

// What an exposure for the mean would burn out or drown.
TEST(HdrFlip, SeesInHighlightsAndInShadows) {
  const FloatPicture a = lights(64, 32, 1);
  for (const int x : {4, 60}) {
    FloatPicture b = a;
    for (int y = 10; y < 20; ++y) {
      for (int c = 0; c < 3; ++c) b.rgb[static_cast<std::size_t>(3 * (y * 64 + x) + c)] *= 1.6F;
    }
    EXPECT_GT(hdr_flip(a, b).map.row(15)[x], 0.1F) << x;
  }
}

TEST(HdrFlip, EqualPicturesAreZeroAndBlackOnesToo) {
  const FloatPicture a = lights(20, 12, 1), black{20, 12, std::vector<float>(3 * 20 * 12)};
  EXPECT_EQ(range(hdr_flip(a, a).map).most, 0);
  EXPECT_EQ(range(hdr_flip(black, black).map).most, 0);
  EXPECT_EQ(exposure_range(black).count, 2);
  FloatPicture half = black;
  half.rgb[0] = half.rgb[1] = half.rgb[2] = 4;  // the median is 0
  EXPECT_TRUE(std::isfinite(exposure_range(half).stop));
}

TEST(HdrFlip, WhatIsNotFiniteIsTheSameOrNot) {
  constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  FloatPicture a = lights(20, 12, 1), b = a;
  a.rgb[0] = b.rgb[0] = inf;
  a.rgb[30] = b.rgb[30] = nan;
  EXPECT_EQ(range(hdr_flip(a, b).map).most, 0);
  b.rgb[30] = 1;
  EXPECT_EQ(hdr_flip(a, b).map.values[10], 1);
}

TEST(HdrFlip, TheSameBitsForAnyThreads) {
  const FloatPicture a = lights(300, 90, 1), b = lights(300, 90, 2);
  const auto with = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return hdr_flip(a, b).map.values;
  };
  EXPECT_EQ(with(1), with(3));
}

TEST(HdrFlip, OtherSizesAreRefused) {
  EXPECT_THROW(hdr_flip(lights(4, 3, 1), lights(3, 4, 1)), SettingsError);
}

}  // namespace hdr_flip_test
}  // namespace lagomorph::render
