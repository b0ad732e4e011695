#include "sim/placement.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace lagomorph::sim {
namespace placement_test {

TEST(Rotation, TurnsAboutTheFixedXThenYThenZ) {
  const double degree = std::acos(-1.0) / 180.0;
  const Mat3 expected =
      (Eigen::AngleAxisd(30 * degree, Vec3::UnitZ()) * Eigen::AngleAxisd(20 * degree, Vec3::UnitY()) *
       Eigen::AngleAxisd(10 * degree, Vec3::UnitX()))
          .toRotationMatrix();
  EXPECT_LT((rotation_of(Vec3(10, 20, 30)) - expected).norm(), 1e-15);
}

TEST(Rotation, IsExactForRightAngles) {
  Mat3 quarter_about_z;
  quarter_about_z << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_EQ(rotation_of(Vec3(0, 0, 90)), quarter_about_z);
  EXPECT_EQ(rotation_of(Vec3(0, 0, -270)), quarter_about_z);
  EXPECT_EQ(rotation_of(Vec3(360, -720, 0)), Mat3::Identity());
  EXPECT_EQ(rotation_of(Vec3(180, 0, 0)), Mat3(Vec3(1, -1, -1).asDiagonal()));
}

TEST(Place, ScalesThenRotatesThenTranslates) {
  Points X(1, 3);
  X << 1, 2, 3;
  BodySettings body;
  body.scale = 2.0;
  body.rotate = Vec3(90, 0, 0);
  body.translate = Vec3(10, 0, 0);
  place(X, body);
  EXPECT_EQ(Vec3(X.row(0)), Vec3(12, -6, 4));
}

TEST(Place, LeavesExactlyWhatIsNotMoved) {
  Points X(2, 3);
  X << 0.1, 0.2, 0.3, 1.0 / 3.0, 1e-300, -7.7;
  const Points before = X;
  place(X, BodySettings{});
  EXPECT_EQ(X, before);
}

}  // namespace placement_test
}  // namespace lagomorph::sim
