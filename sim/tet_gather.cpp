#include "sim/tet_gather.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "sim/parallel.h"
#include "sim/simd.h"

namespace lagomorph::sim {

namespace {

constexpr int kGrain = 512;
constexpr std::size_t kBatchDoubles = 23040;  // of matrices: 256 linear tets, a part of a core's cache

using Block8 = double __attribute__((vector_size(64), aligned(8), may_alias));

/// Of nine doubles.
struct BlockSum {
  Block8 eight = {};
  double last = 0.0;
};

/// Of the blocks that sum t has.
inline __attribute__((always_inline)) BlockSum sum_of_blocks(int t, const int* starts, const int* sources,
                                                             const double* from) {
  BlockSum sum;
  for (int s = starts[t]; s < starts[t + 1]; ++s) {
    const double* block = from + 9 * static_cast<std::ptrdiff_t>(sources[s]);
    sum.eight += *reinterpret_cast<const Block8*>(block);
    sum.last += block[8];
  }
  return sum;
}

/// Sums [begin, end).
LAGOMORPH_SIMD void sum_blocks(int begin, int end, const int* starts, const int* sources, const double* from,
                               double* sums) {
  for (int t = begin; t < end; ++t) {
    const BlockSum sum = sum_of_blocks(t, starts, sources, from);
    double* to = sums + 9 * static_cast<std::ptrdiff_t>(t);
    *reinterpret_cast<Block8*>(to) = sum.eight;
    to[8] = sum.last;
  }
}

/// The same, times `scale` and added to blocks that are there.
LAGOMORPH_SIMD void add_sums_of_blocks(int begin, int end, const int* starts, const int* sources,
                                       const double* from, double scale, double* blocks) {
  for (int t = begin; t < end; ++t) {
    const BlockSum sum = sum_of_blocks(t, starts, sources, from);
    double* to = blocks + 9 * static_cast<std::ptrdiff_t>(t);
    *reinterpret_cast<Block8*>(to) += scale * sum.eight;
    to[8] += scale * sum.last;
  }
}

/// Turns "source s adds to target targets[s]" into the sources of each target, ascending.
void invert(const std::vector<int>& targets, int target_count, std::vector<int>& starts,
            std::vector<int>& sources) {
  starts.assign(static_cast<std::size_t>(target_count) + 1, 0);
  for (const int t : targets) ++starts[static_cast<std::size_t>(t) + 1];
  for (std::size_t t = 0; t + 1 < starts.size(); ++t) starts[t + 1] += starts[t];
  sources.resize(targets.size());
  std::vector<int> next(starts.begin(), starts.end() - 1);
  for (std::size_t s = 0; s < targets.size(); ++s)
    sources[static_cast<std::size_t>(next[static_cast<std::size_t>(targets[s])]++)] = static_cast<int>(s);
}

}  // namespace

TetGather::TetGather(const std::vector<int>& nodes, int nodes_per_element,
                     std::shared_ptr<const BlockPattern> pattern)
    : pattern_(std::move(pattern)),
      matrix_size_(matrix_size(nodes_per_element)),
      element_count_(static_cast<int>(nodes.size()) / nodes_per_element),
      batch_(kGroup * std::max(static_cast<int>(kBatchDoubles / matrix_size_) / kGroup, 1)) {
  invert(nodes, pattern_->vertex_count(), vertex_starts_, vertex_sources_);
  const auto size = static_cast<std::size_t>(nodes_per_element);
  batch_starts_.push_back(0);
  std::vector<int> blocks;                     // of each sum
  std::vector<std::pair<int, int>> additions;  // block, source within the batch
  for (int first = 0; first < element_count_; first += batch_) {
    additions.clear();
    const auto last = static_cast<std::size_t>(std::min(first + batch_, element_count_));
    for (std::size_t j = static_cast<std::size_t>(first); j < last; ++j) {
      for (std::size_t b = 0; b < size; ++b)
        for (std::size_t a = 0; a <= b; ++a)
          additions.emplace_back(pattern_->find(nodes[size * j + a], nodes[size * j + b]),
                                 static_cast<int>(additions.size()));
    }
    std::sort(additions.begin(), additions.end());
    for (const auto& [block, source] : additions) {
      if (static_cast<int>(blocks.size()) == batch_starts_.back() || blocks.back() != block) {
        blocks.push_back(block);
        source_starts_.push_back(static_cast<int>(sources_.size()));
      }
      sources_.push_back(source);
    }
    batch_starts_.push_back(static_cast<int>(blocks.size()));
  }
  source_starts_.push_back(static_cast<int>(sources_.size()));
  invert(blocks, pattern_->block_count(), block_starts_, block_sums_);
}

void TetGather::add_vectors(const std::vector<double>& element_vectors, double scale, VecX& g) const {
  parallel_for(pattern_->vertex_count(), kGrain, [&](int begin, int end) {
    for (int v = begin; v < end; ++v) {
      Vec3 sum = Vec3::Zero();
      for (int s = vertex_starts_[v]; s < vertex_starts_[v + 1]; ++s)
        sum += Eigen::Map<const Vec3>(element_vectors.data() +
                                      3 * static_cast<std::ptrdiff_t>(vertex_sources_[s]));
      g.segment<3>(3 * v) += scale * sum;
    }
  });
}

void TetGather::add_matrices(double scale, BlockHessian& H,
                             const std::function<void(int begin, int end, double* matrices)>& fill) const {
  assert(&H.pattern() == pattern_.get());
  std::vector<double>& sums = H.scratch();
  sums.resize(std::max(sums.size(), 9 * static_cast<std::size_t>(batch_starts_.back())));
  parallel_for(static_cast<int>(batch_starts_.size()) - 1, 1, [&](int begin, int end) {
    thread_local std::vector<double> matrices;  // kept, so that a step allocates nothing
    matrices.resize(std::max(matrices.size(), matrix_size_ * static_cast<std::size_t>(batch_)));
    for (int batch = begin; batch < end; ++batch) {
      fill(batch_ * batch, std::min(batch_ * (batch + 1), element_count_), matrices.data());
      sum_blocks(batch_starts_[static_cast<std::size_t>(batch)],
                 batch_starts_[static_cast<std::size_t>(batch) + 1], source_starts_.data(), sources_.data(),
                 matrices.data(), sums.data());
    }
  });
  parallel_for(pattern_->block_count(), kGrain, [&](int begin, int end) {
    add_sums_of_blocks(begin, end, block_starts_.data(), block_sums_.data(), sums.data(), scale,
                       H.block(0).data());
  });
}

}  // namespace lagomorph::sim
