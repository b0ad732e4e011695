#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "sim/block_hessian.h"
#include "sim/types.h"

namespace lagomorph::sim {

/// Adds element vectors and matrices to global ones: the lecture's Σ_j E_jᵀ f_j and Σ_j E_jᵀ K_j E_j with E_j
/// never formed. Each place of the result sums its elements in their order, so the sums are the same for any
/// number of threads.
class TetGather {
public:
  /// `nodes` has the `nodes_per_element` nodes of each element, one element after the other. They must
  /// ascend, so that the blocks of an element's upper triangle are blocks of the pattern's upper triangle.
  TetGather(const std::vector<int>& nodes, int nodes_per_element,
            std::shared_ptr<const BlockPattern> pattern);

  /// Doubles an element: 3 for each node; 9, column by column, for each pair a <= b.
  static constexpr std::size_t vector_size(int nodes) { return 3 * static_cast<std::size_t>(nodes); }
  static constexpr std::size_t matrix_size(int nodes) { return 9 * static_cast<std::size_t>(pair(0, nodes)); }
  /// Place of pair (a, b), a <= b, among them: (0,0) (0,1) (1,1) (0,2) (1,2) (2,2) (0,3) ...
  static constexpr int pair(int a, int b) { return b * (b + 1) / 2 + a; }

  /// `fill` is asked for whole groups of so many elements, counted from the first, but for the last group.
  static constexpr int kGroup = 8;
  /// Makes those of elements [begin, end), on any thread, with room for whole groups.
  using Fill = std::function<void(int begin, int end, double* of_elements)>;

  /// g += scale · Σ_j E_jᵀ f_j. A batch's are summed while they are still in the cache of the thread that
  /// made them, then these sums.
  void add_vectors(double scale, VecX& g, const Fill& fill) const;
  /// H += scale · Σ_j E_jᵀ K_j E_j, likewise. H must be on the same pattern.
  void add_matrices(double scale, BlockHessian& H, const Fill& fill) const;

private:
  /// What adds to each of some targets: of each batch of elements its sums, one for each target that its
  /// elements add to; of each sum the sources in the batch, and of each target the sums.
  struct Additions {
    int batch = 0;  // elements
    std::vector<int> batch_starts, source_starts, sources, target_starts, target_sums;

    int batch_count() const { return static_cast<int>(batch_starts.size()) - 1; }
    std::size_t sum_count() const { return static_cast<std::size_t>(batch_starts.back()); }
  };
  /// `targets`: those of each element, one element after the other.
  static Additions additions(const std::vector<int>& targets, std::size_t an_element, int batch,
                             int target_count);
  void fill_batches(const Additions&, std::size_t doubles, const Fill& fill,
                    const std::function<void(int batch, const double* of_elements)>& sum) const;

  std::shared_ptr<const BlockPattern> pattern_;
  std::size_t vector_size_, matrix_size_;
  int element_count_;
  Additions vectors_, matrices_;  // to vertices, to blocks
};

}  // namespace lagomorph::sim
