#pragma once

#include <Eigen/Geometry>

#include "sim/element_matrix.h"
#include "sim/materials/invariants.h"
#include "sim/tet_gather.h"

namespace lagomorph::sim {

/// Adds vol Bᵀ (∂²ψ/∂F²) B of a density ψ(I_C, J) to `blocks` as add_inner_blocks() does, without the 9×9
/// matrix: with u_a = F D_a and w_a = (cof F) D_a, block (a, b) is
///   2 ψ_I (D_a·D_b) 1 + 4 ψ_II u_a u_bᵀ + 2 ψ_IJ (u_a w_bᵀ + w_a u_bᵀ) + ψ_JJ w_a w_bᵀ + ψ_J S,
/// where S_rs = ε_rst c_t with c = F (D_a × D_b), since ∂²J/∂F_rk ∂F_sl = ε_rst ε_klm F_tm.
template <int N>
void add_invariant_blocks(double volume, const InvariantDerivatives& d, const Mat3& F,
                          const InnerGradients<N>& D, double* blocks) {
  using Columns = Eigen::Matrix<double, 3, N - 1>;
  const Mat3 G = cofactor(F);
  const Columns u = F * D.transpose(), w = G * D.transpose();
  const Columns by_u = volume * (4.0 * d.II * u + 2.0 * d.IJ * w),
                by_w = volume * (2.0 * d.IJ * u + d.JJ * w);
  for (int b = 1; b < N; ++b) {
    for (int a = 1; a <= b; ++a) {
      Eigen::Map<Mat3> K(blocks + 9 * static_cast<std::ptrdiff_t>(TetGather::pair(a, b)));
      K += u.col(a - 1) * by_u.col(b - 1).transpose() + w.col(a - 1) * by_w.col(b - 1).transpose();
      K.diagonal().array() += volume * 2.0 * d.I * D.row(a - 1).dot(D.row(b - 1));
      if (a == b) continue;
      const Vec3 c = volume * d.J * (F * Vec3(D.row(a - 1)).cross(Vec3(D.row(b - 1))));
      K(0, 1) += c[2];
      K(1, 0) -= c[2];
      K(1, 2) += c[0];
      K(2, 1) -= c[0];
      K(2, 0) += c[1];
      K(0, 2) -= c[1];
    }
  }
}

}  // namespace lagomorph::sim
