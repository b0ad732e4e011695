#include "render/image_compare/fast_math.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lagomorph::render {
namespace fast_math_test {

TEST(FastMath, CubeRoot) {
  for (float x = 1e-6F; x < 1e6F; x *= 1.0003F) {
    const double exact = std::cbrt(static_cast<double>(x));
    ASSERT_NEAR(fast_cbrt(x), exact, 2e-7 * exact) << x;
  }
  EXPECT_EQ(fast_cbrt(1.0F), 1.0F);
}

TEST(FastMath, Logarithm) {
  for (float x = 1e-30F; x < 1e30F; x *= 1.001F) {
    const double exact = std::log2(static_cast<double>(x));
    ASSERT_NEAR(fast_log2(x), exact, 1e-7 * std::max(1.0, std::abs(exact))) << x;
  }
  EXPECT_EQ(fast_log2(1.0F), 0.0F);
  EXPECT_EQ(fast_log2(0.25F), -2.0F);
}

TEST(FastMath, PowerOfTwo) {
  for (float x = -126.0F; x <= 127.0F; x += 0.00137F) {
    const double exact = std::exp2(static_cast<double>(x));
    ASSERT_NEAR(fast_exp2(x), exact, 2e-7 * exact) << x;
  }
  EXPECT_EQ(fast_exp2(0.0F), 1.0F);
  EXPECT_EQ(fast_exp2(-3.0F), 0.125F);
}

}  // namespace fast_math_test
}  // namespace lagomorph::render
