#pragma once

#include <memory>
#include <random>

#include "sim/block_hessian.h"
#include "sim/pins.h"

/// Linear systems to solve.
namespace lagomorph::sim {

/// `shift` times the identity, and what couple(A, C, B) adds for each pair of neighbours to the diagonal
/// blocks A and B of the first and the second and to their common block C.
template <class Couple>
BlockHessian coupled_system(const std::shared_ptr<const BlockPattern>& pattern, double shift,
                            Couple&& couple) {
  BlockHessian H(pattern);
  for (int j = 0; j < pattern->vertex_count(); ++j) {
    H.block(pattern->find(j, j)) += shift * Mat3::Identity();
    for (int k = pattern->starts()[static_cast<std::size_t>(j)];
         k < pattern->starts()[static_cast<std::size_t>(j) + 1]; ++k) {
      const int i = pattern->rows()[static_cast<std::size_t>(k)];
      if (i != j) couple(H.block(pattern->find(i, i)), H.block(k), H.block(pattern->find(j, j)));
    }
  }
  return H;
}

/// Each pair of neighbours coupled at random by [A B]ᵀ[A B], which is positive semi-definite.
inline BlockHessian random_system(const std::shared_ptr<const BlockPattern>& pattern, double shift) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return coupled_system(pattern, shift,
                        [&](Eigen::Map<Mat3> first, Eigen::Map<Mat3> common, Eigen::Map<Mat3> second) {
                          const Mat3 A = Mat3::NullaryExpr([&] { return uniform(random); });
                          const Mat3 B = Mat3::NullaryExpr([&] { return uniform(random); });
                          first += A.transpose() * A;
                          second += B.transpose() * B;
                          common += A.transpose() * B;
                        });
}

/// The graph's Laplacian in each coordinate: smooth vectors are hardly resisted.
inline BlockHessian laplacian_system(const std::shared_ptr<const BlockPattern>& pattern, double shift) {
  return coupled_system(pattern, shift,
                        [](Eigen::Map<Mat3> first, Eigen::Map<Mat3> common, Eigen::Map<Mat3> second) {
                          first += Mat3::Identity();
                          second += Mat3::Identity();
                          common -= Mat3::Identity();
                        });
}

/// x = Pᵀ (P H Pᵀ)⁻¹ P b with a dense factorization.
inline VecX dense_solution(const BlockHessian& H, const Pins& pins, const VecX& b) {
  if (pins.free_dofs() == 0) return VecX::Zero(b.size());
  const SparseMatrix P = pins.matrix();
  const Eigen::MatrixXd reduced = P * H.to_sparse() * SparseMatrix(P.transpose());
  return P.transpose() * VecX(reduced.partialPivLu().solve(VecX(P * b)));
}

/// |P (b - H x)| / |P b|
inline double residual_of(const BlockHessian& H, const Pins& pins, const VecX& b, const VecX& x) {
  return pins.free_norm(b - H.to_sparse() * x) / pins.free_norm(b);
}

}  // namespace lagomorph::sim
