#include "sim/materials/invariants.h"

#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

namespace lagomorph::sim {

namespace {

/// F = U diag(sigma) Vᵀ with rotations U and V: the last singular value takes the sign of det F.
struct RotationSvd {
  Mat3 U = Mat3::Identity(), V = Mat3::Identity();
  Vec3 sigma = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  explicit RotationSvd(const Mat3& F) {
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
};

}  // namespace

/// The eigenvectors that all such densities share: three twists, three flips, and three in the span of the
/// stretches. [Smith, de Goes, Kim 2018, Section 4; 2019, "Analytic Eigensystems for Isotropic Distortion
/// Energies"]
Mat9 projected_stress_derivative(const InvariantDerivatives& d, const Mat3& F) {
  Mat9 H = stress_derivative(d, F);
  const RotationSvd svd(F);
  const Vec3& s = svd.sigma;
  // Takes an eigenvector's part out of H; q is the eigenvector in the frame of the stretches.
  const auto remove = [&](double eigenvalue, const Mat3& q) {
    const Vec9 v = vec(svd.U * q * svd.V.transpose());
    H -= eigenvalue * v * v.transpose();
  };
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double twist = 2.0 * d.I + d.J * s[k], flip = 2.0 * d.I - d.J * s[k];
    Mat3 q = Mat3::Zero();
    q(i, j) = std::sqrt(0.5);
    q(j, i) = -q(i, j);
    if (twist < 0.0) remove(twist, q);
    q(j, i) = q(i, j);
    if (flip < 0.0) remove(flip, q);
  }
  const Vec3 g(s[1] * s[2], s[2] * s[0], s[0] * s[1]);
  Mat3 A = 4.0 * d.II * s * s.transpose() + 2.0 * d.IJ * (s * g.transpose() + g * s.transpose()) +
           d.JJ * g * g.transpose();
  A.diagonal().array() += 2.0 * d.I;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    A(i, j) += d.J * s[k];
    A(j, i) += d.J * s[k];
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> stretches(A);
  for (int k = 0; k < 3 && stretches.eigenvalues()[k] < 0.0; ++k)
    remove(stretches.eigenvalues()[k], stretches.eigenvectors().col(k).asDiagonal());
  return H;
}

}  // namespace lagomorph::sim
