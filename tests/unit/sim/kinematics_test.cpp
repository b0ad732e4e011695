#include "sim/kinematics.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/support/truth.h"

namespace lagomorph::sim {
namespace kinematics_test {

/// The irregular tet of the reference, at rest and deformed.
struct ReferenceTet {
  nlohmann::json truth = truth::json("2_tet/tet.json");
  TetCorners X;
  Vec12 q;
  ReferenceTet() {
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t k = 0; k < 3; ++k) X(static_cast<int>(k), static_cast<int>(a)) = truth["X"][a][k];
    for (std::size_t i = 0; i < 12; ++i) q[static_cast<int>(i)] = truth["deformed"]["q"][i];
  }
  TetCorners x() const { return Eigen::Map<const TetCorners>(q.data()); }

  /// Compares with values in row-major order, relative to the largest of them.
  template <class Actual>
  static void expect_equal(const Actual& actual, const nlohmann::json& row_major) {
    ASSERT_EQ(static_cast<std::size_t>(actual.size()), row_major.size());
    double largest = 0.0;
    for (const double value : row_major) largest = std::max(largest, std::abs(value));
    for (int i = 0; i < actual.rows(); ++i)
      for (int j = 0; j < actual.cols(); ++j)
        EXPECT_NEAR(actual(i, j),
                    row_major[static_cast<std::size_t>(i * actual.cols() + j)].template get<double>(),
                    1e-14 * largest);
  }
};

TEST(ShapeFunctions, MeetTheReferenceTet) {
  const ReferenceTet tet;
  EXPECT_NEAR(tet_volume(tet.X), tet.truth["vol"], 1e-16);
  ReferenceTet::expect_equal(edge_matrix(tet.X), tet.truth["T_rowmajor"]);
  ReferenceTet::expect_equal(dphi_dX(tet.X), tet.truth["D_rowmajor_4x3"]);
}

TEST(ShapeFunctions, AreOneAtTheirCornerAndZeroAtTheOthers) {
  const ReferenceTet tet;
  for (int a = 0; a < 4; ++a)
    EXPECT_LT((phi(tet.X, tet.X.col(a)) - Eigen::Vector4d::Unit(a)).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(ShapeFunctions, SumToOneAndReproduceThePointAlsoOutside) {
  const ReferenceTet tet;
  for (const Vec3& X : {Vec3(0.2, 0.1, 0.3), Vec3(-3, 5, 2)}) {
    const Eigen::Vector4d weights = phi(tet.X, X);
    EXPECT_NEAR(weights.sum(), 1.0, 1e-14);
    EXPECT_LT((tet.X * weights - X).norm(), 1e-14);
  }
}

/// x(X) = Σ φ_i(X) x_i of corners that an affine map has moved is that map.
TEST(ShapeFunctions, InterpolateAnAffineMapExactly) {
  const ReferenceTet tet;
  Mat3 A;
  A << 1.1, 0.2, -0.3, 0.4, 0.9, 0.1, 0.0, -0.2, 1.3;
  const Vec3 b(0.5, -1, 2), X(0.3, 0.2, 0.25);
  const TetCorners x = (A * tet.X).colwise() + b;
  EXPECT_LT((x * phi(tet.X, X) - (A * X + b)).norm(), 1e-14);
}

/// D = ∂φ/∂X: φ is linear, so differences over any step are exact.
TEST(ShapeFunctions, HaveDAsGradient) {
  const ReferenceTet tet;
  const Vec3 X(0.1, 0.2, 0.3), dX(0.4, -0.3, 0.2);
  EXPECT_LT((phi(tet.X, X + dX) - phi(tet.X, X) - dphi_dX(tet.X) * dX).norm(), 1e-15);
}

TEST(DeformationGradient, MeetsTheReferenceTet) {
  const ReferenceTet tet;
  const Mat3 F = deformation_gradient(tet.x(), dphi_dX(tet.X));
  ReferenceTet::expect_equal(F, tet.truth["deformed"]["F_rowmajor"]);
  EXPECT_NEAR(F.determinant(), tet.truth["deformed"]["J"], 1e-14);
}

TEST(DeformationGradient, IsTheCornersTimesD) {
  const ReferenceTet tet;
  const ShapeGradients D = dphi_dX(tet.X);
  EXPECT_LT((deformation_gradient(tet.x(), D) - tet.x() * D).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(DeformationGradient, IsTheLinearPartOfAnAffineMap) {
  const ReferenceTet tet;
  Mat3 A;
  A << 1.1, 0.2, -0.3, 0.4, 0.9, 0.1, 0.0, -0.2, 1.3;
  const TetCorners x = (A * tet.X).colwise() + Vec3(7, -8, 9);
  EXPECT_LT((deformation_gradient(x, dphi_dX(tet.X)) - A).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Strains, OfAStretchInClosedForm) {
  const Mat3 F = Vec3(2.0, 0.5, 1.0).asDiagonal();
  EXPECT_EQ(right_cauchy_green(F), Mat3(Vec3(4.0, 0.25, 1.0).asDiagonal()));
  EXPECT_EQ(green_lagrange(F), Mat3(Vec3(1.5, -0.375, 0.0).asDiagonal()));
}

/// Simple shear x = X + gamma Y: C = [1 gamma 0; gamma 1 + gamma² 0; 0 0 1].
TEST(Strains, OfASimpleShearInClosedForm) {
  const double gamma = 0.5;
  Mat3 F = Mat3::Identity(), C;
  F(0, 1) = gamma;
  C << 1, gamma, 0, gamma, 1 + gamma * gamma, 0, 0, 0, 1;
  EXPECT_EQ(right_cauchy_green(F), C);
  EXPECT_EQ(green_lagrange(F), 0.5 * (C - Mat3::Identity()));
}

TEST(Strains, DoNotSeeRotations) {
  const Mat3 R = Eigen::AngleAxisd(0.8, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_LT(green_lagrange(R).cwiseAbs().maxCoeff(), 1e-15);
  Mat3 F;
  F << 1.1, 0.2, -0.3, 0.4, 0.9, 0.1, 0.0, -0.2, 1.3;
  EXPECT_LT((right_cauchy_green(R * F) - right_cauchy_green(F)).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Vectorisation, GoesRowByRow) {
  Mat3 F;
  F << 0, 1, 2, 3, 4, 5, 6, 7, 8;
  for (int k = 0; k < 9; ++k) EXPECT_EQ(vec(F)[k], k);
}

TEST(Vectorisation, BMeetsTheReferenceTet) {
  const ReferenceTet tet;
  ReferenceTet::expect_equal(B_matrix(dphi_dX(tet.X)), tet.truth["B_rowmajor_9x12"]);
}

TEST(Vectorisation, BTakesCornersToF) {
  const ReferenceTet tet;
  const ShapeGradients D = dphi_dX(tet.X);
  EXPECT_LT((B_matrix(D) * tet.q - vec(deformation_gradient(tet.x(), D))).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(GatherCorners, TakesTheTetsOwn) {
  const VecX q = VecX::LinSpaced(18, 0, 17);
  const TetCorners x = gather_corners(q, {5, 0, 3, 1});
  EXPECT_EQ(x.col(0), Vec3(15, 16, 17));
  EXPECT_EQ(x.col(1), Vec3(0, 1, 2));
  EXPECT_EQ(x.col(2), Vec3(9, 10, 11));
  EXPECT_EQ(x.col(3), Vec3(3, 4, 5));
}

}  // namespace kinematics_test
}  // namespace lagomorph::sim
