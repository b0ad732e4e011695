#pragma once

#include <memory>
#include <random>

#include "sim/block_hessian.h"
#include "sim/pins.h"

/// Linear systems to solve.
namespace lagomorph::sim {

/// A system on a pattern: each pair of neighbours coupled at random by [A B]ᵀ[A B], which is positive
/// semi-definite, and `shift` times the identity.
inline BlockHessian random_system(const std::shared_ptr<const BlockPattern>& pattern, double shift) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  BlockHessian H(pattern);
  for (int j = 0; j < pattern->vertex_count(); ++j) {
    H.block(pattern->find(j, j)) += shift * Mat3::Identity();
    for (int k = pattern->starts()[static_cast<std::size_t>(j)];
         k < pattern->starts()[static_cast<std::size_t>(j) + 1]; ++k) {
      const int i = pattern->rows()[static_cast<std::size_t>(k)];
      if (i == j) continue;
      const Mat3 A = Mat3::NullaryExpr([&] { return uniform(random); });
      const Mat3 B = Mat3::NullaryExpr([&] { return uniform(random); });
      H.block(pattern->find(i, i)) += A.transpose() * A;
      H.block(pattern->find(j, j)) += B.transpose() * B;
      H.block(k) += A.transpose() * B;
    }
  }
  return H;
}

/// The graph's Laplacian in each coordinate, and `shift` times the identity: smooth vectors are hardly
/// resisted.
inline BlockHessian laplacian_system(const std::shared_ptr<const BlockPattern>& pattern, double shift) {
  BlockHessian H(pattern);
  for (int j = 0; j < pattern->vertex_count(); ++j) {
    H.block(pattern->find(j, j)) += shift * Mat3::Identity();
    for (int k = pattern->starts()[static_cast<std::size_t>(j)];
         k < pattern->starts()[static_cast<std::size_t>(j) + 1]; ++k) {
      const int i = pattern->rows()[static_cast<std::size_t>(k)];
      if (i == j) continue;
      H.block(k) -= Mat3::Identity();
      for (const int v : {i, j}) H.block(pattern->find(v, v)) += Mat3::Identity();
    }
  }
  return H;
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
