#include "render/path/sampler.h"

#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace lagomorph::render::path {
namespace sampler_test {

TEST(Sampler, SecondDimensionMeetsItsDirectionNumbers) {
  // Joe and Kuo's second dimension: the polynomial x + 1, v_i = v_{i-1} ^ (v_{i-1} >> 1).
  std::uint32_t direction[32] = {0x80000000U};
  for (int i = 1; i < 32; ++i) direction[i] = direction[i - 1] ^ (direction[i - 1] >> 1);
  for (std::uint32_t n = 0; n < 5000; ++n) {
    const std::uint32_t index = n * 2654435761U;
    std::uint32_t expected = 0;
    for (int bit = 0; bit < 32; ++bit) {
      if ((index >> bit & 1U) != 0) expected ^= direction[bit];
    }
    ASSERT_EQ(reverse_bits(sobol_second_reversed(index)), expected);
  }
}

/// Whether 2^m points fall one into each elementary interval of every shape.
bool is_net(const std::vector<Pair>& points, int m) {
  for (int across = 0; across <= m; ++across) {
    std::set<std::uint32_t> seen;
    for (const Pair& p : points) {
      const auto a = static_cast<std::uint32_t>(p.u * static_cast<float>(1 << across));
      const auto b = static_cast<std::uint32_t>(p.v * static_cast<float>(1 << (m - across)));
      seen.insert(a << 16 | b);
    }
    if (seen.size() != points.size()) return false;
  }
  return true;
}

TEST(Sampler, EveryPowerOfTwoOfAPixelIsANet) {
  for (const int samples : {1, 3, 64, 1024}) {
    const FrameSamples frame(7, 3, samples);
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(5, 2), std::pair(127, 128), std::pair(1279, 719)}) {
      for (std::uint32_t dimension = 0; dimension < 40; ++dimension) {
        std::vector<Pair> points;
        for (int m = 0; (1 << m) <= samples; ++m) {
          while (static_cast<int>(points.size()) < 1 << m) {
            points.push_back(frame.path(x, y, static_cast<int>(points.size())).pair(dimension));
          }
          ASSERT_TRUE(is_net(points, m)) << samples << " " << x << " " << y << " " << dimension << " " << m;
        }
      }
    }
  }
}

TEST(Sampler, AlignedPixelsTogetherAreANet) {
  const int samples = 16;
  const FrameSamples frame(0, 0, samples);
  for (std::uint32_t dimension = 0; dimension < 10; ++dimension) {
    std::vector<Pair> points;
    for (int y = 8; y < 12; ++y) {
      for (int x = 20; x < 24; ++x) {
        for (int s = 0; s < samples; ++s) points.push_back(frame.path(x, y, s).pair(dimension));
      }
    }
    EXPECT_TRUE(is_net(points, 8));
  }
}

TEST(Sampler, DimensionsFramesAndSeedsAreUncorrelated) {
  const int n = 4096;
  const auto correlation = [&](const FrameSamples& a, std::uint32_t i, const FrameSamples& b,
                               std::uint32_t j) {
    double sum = 0.0;
    for (int s = 0; s < n; ++s) {
      sum += (a.path(3, 4, s).pair(i).u - 0.5) * (b.path(3, 4, s).pair(j).u - 0.5);
    }
    return sum / n * 12.0;
  };
  const FrameSamples a(1, 5, n), next(1, 6, n), other(2, 5, n);
  const double bound = 5.0 / std::sqrt(n);
  for (std::uint32_t i = 0; i < 60; ++i) {
    EXPECT_LT(std::abs(correlation(a, i, a, i + 1)), bound) << i;
    EXPECT_LT(std::abs(correlation(a, i, next, i)), bound) << i;
    EXPECT_LT(std::abs(correlation(a, i, other, i)), bound) << i;
  }
  EXPECT_NEAR(correlation(a, 0, a, 0), 1.0, 1e-3);
}

TEST(Sampler, PairsFillTheUnitSquareEvenlyTogether) {
  // Pairs of pairs are as independent numbers: 16 cells of (u of one, u of the next) hold alike many.
  const int n = 1 << 14;
  const FrameSamples frame(9, 0, n);
  for (std::uint32_t dimension = 0; dimension < 20; ++dimension) {
    double count[16] = {};
    for (int s = 0; s < n; ++s) {
      const PathSamples samples = frame.path(10, 10, s);
      const int a = static_cast<int>(4.0F * samples.pair(dimension).u);
      const int b = static_cast<int>(4.0F * samples.pair(dimension + 1).u);
      ++count[4 * a + b];
    }
    double chi2 = 0.0;
    for (const double c : count) chi2 += (c - n / 16.0) * (c - n / 16.0) / (n / 16.0);
    EXPECT_LT(chi2, 40.0) << dimension;  // 9 degrees of freedom: 1e-5
  }
}

TEST(Sampler, NumbersAreBelowOne) {
  const FrameSamples frame(0, 0, 65536);
  for (int s = 0; s < 65536; ++s) {
    const Pair p = frame.path(127, 127, s).pair(1);
    ASSERT_TRUE(p.u >= 0.0F && p.u < 1.0F && p.v >= 0.0F && p.v < 1.0F);
  }
}

}  // namespace sampler_test
}  // namespace lagomorph::render::path
