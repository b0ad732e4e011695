#include "sim/materials/stretches.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

namespace lagomorph::sim {

namespace {

/// vec(U q Vᵀ).
Vec9 in_space(const RotationSvd& svd, const Mat3& q) { return vec(svd.U * q * svd.V.transpose()); }

/// T_k (sign -1) or L_k (sign +1).
Mat3 pair_matrix(int k, double sign) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  Mat3 q = Mat3::Zero();
  q(i, j) = std::sqrt(0.5);
  q(j, i) = sign * q(i, j);
  return q;
}

}  // namespace

RotationSvd::RotationSvd(const Mat3& F)
    : U(Mat3::Identity()),
      V(Mat3::Identity()),
      sigma(Vec3::Constant(std::numeric_limits<double>::quiet_NaN())) {
  const Eigen::JacobiSVD<Mat3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (svd.info() != Eigen::Success) return;  // F is not finite
  U = svd.matrixU();
  V = svd.matrixV();
  sigma = svd.singularValues();
  if (U.determinant() < 0.0) {
    U.col(2) *= -1.0;
    sigma[2] *= -1.0;
  }
  if (V.determinant() < 0.0) {
    V.col(2) *= -1.0;
    sigma[2] *= -1.0;
  }
}

Mat9 without_negative_eigenvalues(Mat9 H, const RotationSvd& svd, const StretchEigensystem& eigen) {
  const auto remove = [&](double eigenvalue, const Mat3& q) {
    const Vec9 v = in_space(svd, q);
    H -= eigenvalue * v * v.transpose();
  };
  for (int k = 0; k < 3; ++k) {
    if (eigen.twist[k] < 0.0) remove(eigen.twist[k], pair_matrix(k, -1.0));
    if (eigen.flip[k] < 0.0) remove(eigen.flip[k], pair_matrix(k, 1.0));
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> stretches(eigen.scaling);
  for (int k = 0; k < 3 && stretches.eigenvalues()[k] < 0.0; ++k)
    remove(stretches.eigenvalues()[k], stretches.eigenvectors().col(k).asDiagonal());
  return H;
}

Vec3 pair_sums(const RotationSvd& svd) {
  Vec3 sums;
  for (int k = 0; k < 3; ++k)
    sums[k] = std::max(svd.sigma[(k + 1) % 3] + svd.sigma[(k + 2) % 3], kLeastPairSum);
  return sums;
}

Mat9 rotation_derivative(const RotationSvd& svd) {
  const Vec3 sums = pair_sums(svd);
  Mat9 dR = Mat9::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vec9 t = in_space(svd, pair_matrix(k, -1.0));
    dR += 2.0 / sums[k] * t * t.transpose();
  }
  return dR;
}

}  // namespace lagomorph::sim
