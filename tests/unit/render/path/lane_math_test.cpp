#include "render/path/lane_math.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace lagomorph::render::path {
namespace lane_math_test {

TEST(LaneMath, SineAndCosineOfTurnsAreGoodTo1e7) {
  double worst = 0.0;
  for (int i = 0; i <= 100000; ++i) {
    const float turns = static_cast<float>(i) / 50000.0F;
    const SinCos of = sincos_of_turns(turns);
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(turns);
    worst = std::max(worst, std::abs(static_cast<double>(of.sine) - std::sin(angle)));
    worst = std::max(worst, std::abs(static_cast<double>(of.cosine) - std::cos(angle)));
  }
  EXPECT_LT(worst, 1.5e-7);
}

TEST(LaneMath, ArcCosineIsGoodTo3e7) {
  double worst = 0.0;
  for (int i = -100000; i <= 100000; ++i) {
    const float x = static_cast<float>(i) / 100000.0F;
    worst = std::max(worst, std::abs(static_cast<double>(arc_cosine(x)) - std::acos(static_cast<double>(x))));
  }
  EXPECT_LT(worst, 4e-7);
}

TEST(LaneMath, FramesAreOrthonormalAndRightHanded) {
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 1000; ++i) {
    const F3 n = normalized({normal(random), normal(random), normal(random)});
    const Frame f = frame_of(n);
    EXPECT_NEAR(dot(f.t, f.t), 1.0F, 2e-6F);
    EXPECT_NEAR(dot(f.b, f.b), 1.0F, 2e-6F);
    EXPECT_NEAR(dot(f.t, f.b), 0.0F, 2e-6F);
    EXPECT_NEAR(dot(f.t, n), 0.0F, 2e-6F);
    EXPECT_NEAR(vec3(f.t).cross(vec3(f.b)).dot(vec3(n)), 1.0F, 2e-6F);
  }
}

}  // namespace lane_math_test
}  // namespace lagomorph::render::path
