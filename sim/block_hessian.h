#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "sim/types.h"

namespace lagomorph::sim {

enum class HessianKind {
  exact,      // ∂²V/∂q² as it is; may be indefinite
  projected,  // each element's Hessian clamped to positive semi-definite
};

/// Which 3×3 blocks of a symmetric matrix over vertices can be nonzero: the upper triangle (row <= column) by
/// block columns, rows ascending, each diagonal block present. Made once a topology.
class BlockPattern {
public:
  /// Blocks of each pair of vertices that share a tet; `midsides` are as in a TetMesh.
  BlockPattern(int vertex_count, const std::vector<Tet>& tets, const std::vector<Midsides>& midsides = {});

  int vertex_count() const { return static_cast<int>(starts_.size()) - 1; }
  int block_count() const { return static_cast<int>(rows_.size()); }
  /// Blocks of column j are [starts()[j], starts()[j + 1]); the last of them is the diagonal one.
  const std::vector<int>& starts() const { return starts_; }
  const std::vector<int>& rows() const { return rows_; }
  /// Index of block (i, j), i <= j. The block must be there.
  int find(int i, int j) const;

private:
  std::vector<int> starts_, rows_;
};

/// Symmetric sparse matrix of 3×3 blocks on a BlockPattern. [N/m], or what its owner says.
class BlockHessian {
public:
  explicit BlockHessian(std::shared_ptr<const BlockPattern> pattern);

  const BlockPattern& pattern() const { return *pattern_; }
  const std::shared_ptr<const BlockPattern>& shared_pattern() const { return pattern_; }
  void set_zero();
  /// H += scale · A, on the same pattern.
  void add(double scale, const BlockHessian& A);
  /// (1 - t) A + t B, block by block; on the same pattern.
  void set_blend(const BlockHessian& A, const BlockHessian& B, double t);
  Eigen::Map<Mat3> block(int k) {
    return Eigen::Map<Mat3>(values_.data() + 9 * static_cast<std::ptrdiff_t>(k));
  }
  Eigen::Map<const Mat3> block(int k) const {
    return Eigen::Map<const Mat3>(values_.data() + 9 * static_cast<std::ptrdiff_t>(k));
  }
  /// Room for a term's element matrices while it adds them: kept, so that a step allocates nothing.
  std::vector<double>& scratch() { return scratch_; }
  /// H x, 3n.
  VecX times(const VecX& x) const;
  /// What half a unit in the last place of each x_j does to H x, 3n; the errors add up as random ones do.
  VecX rounding_of_times(const VecX& x) const;
  /// Both triangles, 3n×3n.
  SparseMatrix to_sparse() const;

private:
  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<double> values_;  // 9 a block, column by column
  std::vector<double> scratch_;
};

}  // namespace lagomorph::sim
