#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/block_hessian.h"
#include "sim/pins.h"

namespace lagomorph::sim {

enum class CgStatus {
  converged,
  negative_curvature,  // the matrix is not positive definite; x is of no use
  gave_up,             // iterations ran out, or will; x is the best so far, downhill of ½ xᵀHx - bᵀx
};

struct CgReport {
  CgStatus status = CgStatus::converged;
  int iterations = 0;
  double residual = 0.0;  // |b - H x| / |b|
};

/// When conjugate gradients stop.
struct CgLimits {
  double tolerance = 1e-6;  // |b - H x| <= tolerance |b|
  int max_iterations = 1000;
  /// Every `probe` iterations, if not 0, they also give up when at the rate so far it takes them too long to
  /// bring the residual down to `goal`, which may be less than the tolerance: 1.5 times `budget` iterations
  /// in the end, and 3 times as many at the first probe, for the rate is slow at the beginning.
  int probe = 0;
  double goal = 0.0;
  double budget = 0.0;
};

/// A symmetric positive definite system as conjugate gradients see it. Vectors are of whatever size and
/// order.
class CgSystem {
public:
  virtual ~CgSystem() = default;
  /// y = H p; returns pᵀ y.
  virtual double times(const VecX& p, VecX& y) = 0;
  struct Products {
    double rr = 0.0, rz = 0.0;  // rᵀr, rᵀz
  };
  /// x += alpha p, r -= alpha y, z = B r with the preconditioner B ≈ H⁻¹.
  virtual Products update(double alpha, const VecX& p, const VecX& y, VecX& x, VecX& r, VecX& z) = 0;
};

/// Preconditioned conjugate gradients from x = 0. [Hestenes and Stiefel 1952]
CgReport conjugate_gradients(CgSystem&, const VecX& b, const CgLimits&, VecX& x);

/// P H Pᵀ by rows of 3×3 blocks, both triangles, in an order that keeps neighbours together, preconditioned
/// by the inverses of the diagonal blocks (block Jacobi). Products are in single precision, which is half the
/// memory to go through, the vectors in double; what rounding took of the residual in the end, and any doubt
/// whether the matrix is positive definite, is gone after in double.
class BlockJacobiCg {
public:
  /// Orders the free vertices. Made once a topology.
  void analyze(std::shared_ptr<const BlockPattern>, const Pins&);
  bool is_analyzed() const { return pattern_ != nullptr; }
  /// Takes the values of H, which must be on the analyzed pattern. False when a diagonal block is not
  /// positive definite, and so H is not.
  bool set_matrix(const BlockHessian& H);
  /// x = Pᵀ (P H Pᵀ)⁻¹ P b, 3n: zero where pinned.
  CgReport solve(const VecX& b, const CgLimits&, VecX& x);
  /// Blocks that a product reads.
  std::int64_t block_count() const { return static_cast<std::int64_t>(columns_.size()); }

private:
  class System;
  int row_count() const { return static_cast<int>(vertices_.size()); }
  bool set_row(const BlockHessian& H, std::size_t row);

  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<int> vertices_;             // in their order here
  std::vector<unsigned char> free_axes_;  // of each, a bit an axis
  std::vector<int> starts_;               // of each row
  std::vector<int> columns_;              // places in vertices_
  std::vector<int> sources_;              // block of the pattern; ~block: transposed
  std::vector<double> values_;            // 9 a block, column by column, and one more
  std::vector<float> rounded_;            // likewise, and three more
  std::vector<double> inverses_;          // of the diagonal blocks, as values_
};

}  // namespace lagomorph::sim
