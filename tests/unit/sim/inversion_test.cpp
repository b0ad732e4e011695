#include "sim/inversion.h"

#include <limits>
#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace lagomorph::sim {
namespace inversion_test {

constexpr double kNever = std::numeric_limits<double>::infinity();

TEST(FirstInversion, OfASquashInClosedForm) {
  const Mat3 F = Mat3::Identity();
  EXPECT_NEAR(first_inversion(F, Vec3(0, -4, 0).asDiagonal(), 1.0), 0.25, 1e-15);     // linear
  EXPECT_NEAR(first_inversion(F, Vec3(-2, -4, 0).asDiagonal(), 1.0), 0.25, 1e-15);    // quadratic
  EXPECT_NEAR(first_inversion(F, Vec3(-2, -4, -8).asDiagonal(), 1.0), 0.125, 1e-15);  // cubic
  EXPECT_NEAR(first_inversion(F, Vec3(3, -4, 5).asDiagonal(), 1.0), 0.25, 1e-15);
}

TEST(FirstInversion, IsNoneWhenItLiesBeyondTheLimit) {
  EXPECT_EQ(first_inversion(Mat3::Identity(), Vec3(0, -0.9, 0).asDiagonal(), 1.0), kNever);
  EXPECT_EQ(first_inversion(Mat3::Identity(), Mat3::Zero(), 1.0), kNever);
  EXPECT_EQ(first_inversion(Mat3::Identity(), Mat3::Identity(), 1.0), kNever);
}

/// Two axes through zero at once: the determinant touches zero and is positive again after.
TEST(FirstInversion, SeesADeterminantThatOnlyTouchesZero) {
  EXPECT_NEAR(first_inversion(Mat3::Identity(), Vec3(-2, -2, 0).asDiagonal(), 1.0), 0.5, 1e-7);
}

/// It turns inside out and back within the step: the ends alone look innocent.
TEST(FirstInversion, SeesAPairOfRootsInside) {
  EXPECT_NEAR(first_inversion(Mat3::Identity(), Vec3(-4, -2, 0).asDiagonal(), 1.0), 0.25, 1e-15);
}

TEST(FirstInversion, AgreesWithAFineScan) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int inverted = 0;
  for (int n = 0; n < 300; ++n) {
    const Mat3 F = Mat3::Identity() + 0.4 * Mat3::NullaryExpr([&] { return uniform(random); });
    const Mat3 dF = 2.0 * Mat3::NullaryExpr([&] { return uniform(random); });
    const double t = first_inversion(F, dF, 1.0);
    const double end = std::min(t, 1.0);
    for (int k = 0; k < 1000; ++k) ASSERT_GT((F + k * 1e-3 * end * dF).determinant(), 0.0) << n << ' ' << k;
    if (t == kNever) continue;
    ++inverted;
    EXPECT_NEAR((F + t * dF).determinant(), 0.0, 1e-13);
  }
  EXPECT_GT(inverted, 50);
}

TEST(StepWithoutInversion, KeepsAMargin) {
  EXPECT_NEAR(step_without_inversion(Mat3::Identity(), Vec3(0, -4, 0).asDiagonal()), 0.9 * 0.25, 1e-15);
  EXPECT_NEAR(step_without_inversion(Mat3::Identity(), Vec3(0, -1, 0).asDiagonal()), 0.9, 1e-15);
  EXPECT_EQ(step_without_inversion(Mat3::Identity(), Vec3(0, -0.5, 0).asDiagonal()), 1.0);
}

TEST(StepWithoutInversion, WorksFromANearlyFlatTet) {
  const Mat3 F = Vec3(1, 1e-9, 1).asDiagonal();
  EXPECT_NEAR(step_without_inversion(F, Vec3(0, -1, 0).asDiagonal()), 0.9e-9, 1e-20);
  EXPECT_EQ(step_without_inversion(F, Vec3(0, 1, 0).asDiagonal()), 1.0);
}

}  // namespace inversion_test
}  // namespace lagomorph::sim
