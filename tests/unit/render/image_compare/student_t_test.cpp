#include "render/image_compare/student_t.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace lagomorph::render {
namespace student_t_test {

void expect_relative(double value, double expected, double tolerance, const char* what) {
  EXPECT_NEAR(value / expected, 1.0, tolerance) << what << ": " << value << ", not " << expected;
}

TEST(StudentT, OneAndTwoDegreesOfFreedomHaveClosedForms) {
  for (const double t : {0.01, 0.5, 1.0, 3.0, 40.0, 1e4}) {
    expect_relative(two_sided_p(t, 1), std::atan(1.0 / t) * 2.0 / std::numbers::pi, 1e-11, "one");
    const double s = std::sqrt(2.0 + t * t);
    expect_relative(two_sided_p(t, 2), 2.0 / (s * (s + t)), 1e-11, "two");
    EXPECT_EQ(two_sided_p(-t, 2), two_sided_p(t, 2));
  }
}

TEST(StudentT, FiveInAHundredAreBeyondTheTablesQuantiles) {
  EXPECT_NEAR(two_sided_p(2.570582, 5), 0.05, 1e-7);
  EXPECT_NEAR(two_sided_p(2.228139, 10), 0.05, 1e-7);
  EXPECT_NEAR(two_sided_p(2.042272, 30), 0.05, 1e-7);
  EXPECT_NEAR(two_sided_p(1.983972, 100), 0.05, 1e-7);
}

TEST(StudentT, ManyDegreesOfFreedomAreTheNormalDistribution) {
  for (const double t : {0.1, 1.0, 2.0, 5.0}) {
    expect_relative(two_sided_p(t, 1e7), std::erfc(t / std::numbers::sqrt2), 1e-4, "normal");
  }
}

TEST(StudentT, HasItsEnds) {
  EXPECT_EQ(two_sided_p(0, 7), 1.0);
  EXPECT_EQ(two_sided_p(std::numeric_limits<double>::infinity(), 7), 0.0);
  EXPECT_EQ(two_sided_p(1e200, 30), 0.0);
  EXPECT_GT(two_sided_p(500, 30), 0.0);
  EXPECT_LT(two_sided_p(500, 30), 1e-50);
}

}  // namespace student_t_test
}  // namespace lagomorph::render
