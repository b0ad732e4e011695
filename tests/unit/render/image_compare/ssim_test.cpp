#include "render/image_compare/ssim.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "render/image_compare/differences.h"
#include "tests/support/pictures.h"

namespace lagomorph::render {
namespace ssim_test {

using tests::bytes_of;
using tests::grainy;

/// Wang's Eq. 13 window by window in double, with covariances as they are defined.
double slow_ssim(const Pixels& a, const Pixels& b) {
  std::vector<double> window;
  double total = 0;
  for (int j = -5; j <= 5; ++j) {
    for (int i = -5; i <= 5; ++i) total += window.emplace_back(std::exp(-(i * i + j * j) / 4.5));
  }
  const double c1 = std::pow(0.01 * 255, 2);
  const double c2 = std::pow(0.03 * 255, 2);
  double sum = 0;
  for (int y = 5; y < a.height - 5; ++y) {
    for (int x = 5; x < a.width - 5; ++x) {
      for (int c = 0; c < 3; ++c) {
        const auto each = [&](const auto& f) {
          double weighted = 0;
          for (int j = -5; j <= 5; ++j) {
            for (int i = -5; i <= 5; ++i) {
              const auto at = static_cast<std::size_t>(3 * ((y + j) * a.width + x + i) + c);
              weighted += window[static_cast<std::size_t>((j + 5) * 11 + i + 5)] / total *
                          f(double(bytes_of(a)[at]), double(bytes_of(b)[at]));
            }
          }
          return weighted;
        };
        const double mean_a = each([](double p, double) { return p; });
        const double mean_b = each([](double, double q) { return q; });
        const double variance_a = each([&](double p, double) { return (p - mean_a) * (p - mean_a); });
        const double variance_b = each([&](double, double q) { return (q - mean_b) * (q - mean_b); });
        const double covariance = each([&](double p, double q) { return (p - mean_a) * (q - mean_b); });
        sum += (2 * mean_a * mean_b + c1) * (2 * covariance + c2) /
               ((mean_a * mean_a + mean_b * mean_b + c1) * (variance_a + variance_b + c2));
      }
    }
  }
  return sum / (3.0 * (a.width - 10) * (a.height - 10));
}

TEST(Ssim, IsWangsWindowByWindow) {
  for (const auto& [width, height] : {std::pair{11, 11}, {30, 11}, {11, 30}, {40, 33}}) {
    for (const unsigned grain : {4U, 64U}) {
      const Pixels a = grainy(width, height, 1, grain);
      const Pixels b = grainy(width, height, 2, grain);
      EXPECT_NEAR(ssim(a, b).value(), slow_ssim(a, b), 1e-6) << width << "x" << height;
    }
  }
}

TEST(Ssim, OfUnlikePictures) {
  Pixels inverted = grainy(40, 30, 1);
  for (std::uint8_t& s : bytes_of(inverted)) s = static_cast<std::uint8_t>(255 - s);
  EXPECT_NEAR(ssim(grainy(40, 30, 1), inverted).value(), slow_ssim(grainy(40, 30, 1), inverted), 1e-6);
}

TEST(Ssim, FlatPicturesByTheirMeansAlone) {
  // (2 x y + C1) / (x^2 + y^2 + C1): in flat regions nothing may be left of the variances.
  const Pixels a{.width = 50, .height = 40, .samples = std::vector<std::uint8_t>(6000, 50)};
  const Pixels b{.width = 50, .height = 40, .samples = std::vector<std::uint8_t>(6000, 150)};
  EXPECT_NEAR(ssim(a, b).value(), (2 * 50.0 * 150 + 6.5025) / (50.0 * 50 + 150.0 * 150 + 6.5025), 1e-7);
}

TEST(Ssim, OfEqualPicturesIsOne) {
  const Pixels a = grainy(300, 90, 1);
  EXPECT_EQ(ssim(a, a).value(), 1);
}

TEST(Ssim, NothingUnderAWindow) {
  EXPECT_FALSE(ssim(grainy(10, 50, 1), grainy(10, 50, 2)).has_value());
  EXPECT_FALSE(ssim(grainy(50, 10, 1), grainy(50, 10, 2)).has_value());
  EXPECT_TRUE(ssim(grainy(11, 11, 1), grainy(11, 11, 2)).has_value());
}

TEST(Ssim, TheSameBitsForEveryNumberOfThreadsAndInstructionSet) {
  const Pixels a = grainy(700, 150, 1);
  const Pixels b = grainy(700, 150, 2);
  const auto with_threads = [&](std::size_t threads, InstructionSet set) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return ssim(a, b, set).value();
  };
  const double one = with_threads(1, InstructionSet::base);
  EXPECT_EQ(with_threads(4, InstructionSet::base), one);
  EXPECT_EQ(with_threads(1, widest_instruction_set()), one);
  EXPECT_EQ(with_threads(3, widest_instruction_set()), one);
}

TEST(Ssim, SixteenBitsAndAlphaChangeNothing) {
  const Pixels a = grainy(60, 50, 1);
  const Pixels b = grainy(60, 50, 2);
  EXPECT_NEAR(ssim(widened(a), widened(b)).value(), ssim(a, b).value(), 1e-7);
  Pixels with_alpha{.width = 60, .height = 50, .channels = 4, .alpha = true, .samples = {}};
  for (std::size_t i = 0; i < bytes_of(a).size(); ++i) {
    bytes_of(with_alpha).push_back(bytes_of(a)[i]);
    if (i % 3 == 2) bytes_of(with_alpha).push_back(static_cast<std::uint8_t>(i % 251));
  }
  EXPECT_EQ(ssim(with_alpha, b).value(), ssim(a, b).value());
}

}  // namespace ssim_test
}  // namespace lagomorph::render
