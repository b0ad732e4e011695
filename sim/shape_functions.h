#pragma once

#include "sim/types.h"

namespace lagomorph::sim {

/// The four corners of a tet, one a column. [m]
using TetCorners = Eigen::Matrix<double, 3, 4>;

/// T = [X1-X0, X2-X0, X3-X0], 3×3 [m]. (lecture, "Barycentric coordinates")
inline Mat3 edge_matrix(const TetCorners& X) { return X.rightCols<3>().colwise() - X.col(0); }

/// Volume of a tet, det(T)/6 [m^3]; negative when it is inverted.
inline double tet_volume(const TetCorners& X) { return edge_matrix(X).determinant() / 6.0; }

/// Shape functions φ_0..φ_3 at a point X: the barycentric coordinates, φ_1..3 = T⁻¹(X - X0), φ_0 = 1 - Σ φ_i.
/// They sum to one, and interpolate: x(X) = Σ φ_i(X) x_i. (lecture, "Shape functions")
inline Eigen::Vector4d phi(const TetCorners& corners, const Vec3& X) {
  const Vec3 b = edge_matrix(corners).inverse() * (X - corners.col(0));
  return {1.0 - b.sum(), b.x(), b.y(), b.z()};
}

/// D = ∂φ/∂X, 4×3 [1/m], constant in a linear tet: [-1ᵀT⁻¹; T⁻¹]. (lecture, "Deformation gradient")
inline Eigen::Matrix<double, 4, 3> dphi_dX(const TetCorners& corners) {
  const Mat3 T_inverse = edge_matrix(corners).inverse();
  Eigen::Matrix<double, 4, 3> D;
  D.row(0) = -T_inverse.colwise().sum();
  D.bottomRows<3>() = T_inverse;
  return D;
}

}  // namespace lagomorph::sim
