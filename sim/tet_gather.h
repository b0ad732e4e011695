#pragma once

#include <memory>
#include <vector>

#include "sim/block_hessian.h"
#include "sim/tet_mesh.h"
#include "sim/types.h"

namespace lagomorph::sim {

/// Adds element vectors and matrices to global ones: the lecture's Σ_j E_jᵀ f_j and Σ_j E_jᵀ K_j E_j with E_j
/// never formed. Each place of the result sums its elements in their order, so the sums are the same for any
/// number of threads.
class TetGather {
public:
  /// The corners of each tet must ascend, so that the blocks of its upper triangle are blocks of the
  /// pattern's upper triangle.
  TetGather(const std::vector<Tet>& ascending_tets, std::shared_ptr<const BlockPattern> pattern);

  static constexpr int kVectorSize = 12;  // doubles an element: 3 for each corner
  static constexpr int kMatrixSize =
      90;  // doubles an element: 9, column by column, for each of the 10 pairs a <= b
  /// Place of pair (a, b), a <= b, among the ten: (0,0) (0,1) (1,1) (0,2) (1,2) (2,2) (0,3) ...
  static constexpr int pair(int a, int b) { return b * (b + 1) / 2 + a; }

  /// g += scale · Σ_j E_jᵀ f_j.
  void add_vectors(const std::vector<double>& element_vectors, double scale, VecX& g) const;
  /// H += scale · Σ_j E_jᵀ K_j E_j. H must be on the same pattern.
  void add_matrices(const std::vector<double>& element_matrices, double scale, BlockHessian& H) const;

private:
  std::shared_ptr<const BlockPattern> pattern_;
  // Of each vertex (each block of the pattern), the element vectors (matrices) that add to it.
  std::vector<int> vertex_starts_, vertex_sources_;
  std::vector<int> block_starts_, block_sources_;
};

}  // namespace lagomorph::sim
