#pragma once

#include <Eigen/LU>

#include "sim/shape_functions.h"
#include "sim/types.h"

namespace lagomorph::sim {

using Vec9 = Eigen::Matrix<double, 9, 1>;
using Vec12 = Eigen::Matrix<double, 12, 1>;
using Mat9 = Eigen::Matrix<double, 9, 9>;
using Mat12 = Eigen::Matrix<double, 12, 12>;
using ShapeGradients = Eigen::Matrix<double, 4, 3>;  // D

/// q_j = E_j q: the four corners of a tet out of q, as columns. [m]
inline TetCorners gather_corners(const VecX& q, const Tet& tet) {
  TetCorners x;
  for (int a = 0; a < 4; ++a) x.col(a) = q.segment<3>(3 * tet[a]);
  return x;
}

/// Deformation gradient F = ∂x/∂X = (x0 x1 x2 x3) D. (lecture, "Deformation gradient")
/// The rows of D sum to zero, so x0 may be taken off first, which rounds less far from the origin.
inline Mat3 deformation_gradient(const TetCorners& x, const ShapeGradients& D) {
  return edge_matrix(x) * D.bottomRows<3>();
}

/// Right Cauchy-Green deformation C = FᵀF.
inline Mat3 right_cauchy_green(const Mat3& F) { return F.transpose() * F; }

/// Green-Lagrange strain E = (FᵀF - I)/2.
inline Mat3 green_lagrange(const Mat3& F) { return 0.5 * (right_cauchy_green(F) - Mat3::Identity()); }

/// vec(F), row by row: F00 F01 F02 F10 ... (lecture, "Vectorised deformation gradient")
inline Vec9 vec(const Mat3& F) {
  Vec9 v;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(v.data()) = F;
  return v;
}

/// B_j, 9×12 [1/m]: vec(F) = B_j q_j with q_j = (x0 y0 z0 x1 ... z3). Row 3r + k, column 3a + r holds D_ak.
inline Eigen::Matrix<double, 9, 12> B_matrix(const ShapeGradients& D) {
  Eigen::Matrix<double, 9, 12> B = Eigen::Matrix<double, 9, 12>::Zero();
  for (int r = 0; r < 3; ++r)
    for (int k = 0; k < 3; ++k)
      for (int a = 0; a < 4; ++a) B(3 * r + k, 3 * a + r) = D(a, k);
  return B;
}

}  // namespace lagomorph::sim
