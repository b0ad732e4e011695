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
constexpr int kVectorBatch = 512;             // elements: few enough to keep the threads busy

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

/// Of the vectors that sum t has.
inline __attribute__((always_inline)) Vec3 sum_of_vectors(int t, const int* starts, const int* sources,
                                                          const double* from) {
  Vec3 sum = Vec3::Zero();
  for (int s = starts[t]; s < starts[t + 1]; ++s)
    sum += Eigen::Map<const Vec3>(from + 3 * static_cast<std::ptrdiff_t>(sources[s]));
  return sum;
}

/// Sums [begin, end).
void sum_vectors(int begin, int end, const int* starts, const int* sources, const double* from,
                 double* sums) {
  for (int t = begin; t < end; ++t)
    Eigen::Map<Vec3>(sums + 3 * static_cast<std::ptrdiff_t>(t)) = sum_of_vectors(t, starts, sources, from);
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

TetGather::Additions TetGather::additions(const std::vector<int>& targets, std::size_t an_element, int batch,
                                          int target_count) {
  Additions made;
  made.batch = batch;
  made.batch_starts.push_back(0);
  std::vector<int> target_of_sum;
  std::vector<std::pair<int, int>> of_batch;  // target, source within the batch
  const std::size_t step = an_element * static_cast<std::size_t>(batch);
  for (std::size_t first = 0; first < targets.size(); first += step) {
    of_batch.clear();
    for (std::size_t s = first; s < std::min(first + step, targets.size()); ++s)
      of_batch.emplace_back(targets[s], static_cast<int>(s - first));
    std::sort(of_batch.begin(), of_batch.end());
    for (const auto& [target, source] : of_batch) {
      if (static_cast<int>(target_of_sum.size()) == made.batch_starts.back() ||
          target_of_sum.back() != target) {
        target_of_sum.push_back(target);
        made.source_starts.push_back(static_cast<int>(made.sources.size()));
      }
      made.sources.push_back(source);
    }
    made.batch_starts.push_back(static_cast<int>(target_of_sum.size()));
  }
  made.source_starts.push_back(static_cast<int>(made.sources.size()));
  invert(target_of_sum, target_count, made.target_starts, made.target_sums);
  return made;
}

TetGather::TetGather(const std::vector<int>& nodes, int nodes_per_element,
                     std::shared_ptr<const BlockPattern> pattern)
    : pattern_(std::move(pattern)),
      vector_size_(vector_size(nodes_per_element)),
      matrix_size_(matrix_size(nodes_per_element)),
      element_count_(static_cast<int>(nodes.size()) / nodes_per_element) {
  const auto size = static_cast<std::size_t>(nodes_per_element);
  vectors_ = additions(nodes, size, kVectorBatch, pattern_->vertex_count());
  const int matrix_batch = kGroup * std::max(static_cast<int>(kBatchDoubles / matrix_size_) / kGroup, 1);
  std::vector<int> blocks;
  blocks.reserve(nodes.size() / size * matrix_size_ / 9);
  for (std::size_t first = 0; first < nodes.size(); first += size) {
    for (std::size_t b = 0; b < size; ++b)
      for (std::size_t a = 0; a <= b; ++a)
        blocks.push_back(pattern_->find(nodes[first + a], nodes[first + b]));
  }
  matrices_ = additions(blocks, matrix_size_ / 9, matrix_batch, pattern_->block_count());
}

void TetGather::fill_batches(const Additions& to, std::size_t doubles, const Fill& fill,
                             const std::function<void(int batch, const double* of_elements)>& sum) const {
  parallel_for(to.batch_count(), 1, [&](int begin, int end) {
    thread_local std::vector<double> of_elements;  // kept, so that a step allocates nothing
    of_elements.resize(std::max(of_elements.size(), doubles * static_cast<std::size_t>(to.batch)));
    for (int batch = begin; batch < end; ++batch) {
      fill(to.batch * batch, std::min(to.batch * (batch + 1), element_count_), of_elements.data());
      sum(batch, of_elements.data());
    }
  });
}

void TetGather::add_vectors(double scale, VecX& g, const Fill& fill) const {
  thread_local std::vector<double> kept;
  kept.resize(std::max(kept.size(), 3 * vectors_.sum_count()));
  std::vector<double>& sums = kept;  // the calling thread's
  fill_batches(vectors_, vector_size_, fill, [&](int batch, const double* vectors) {
    sum_vectors(vectors_.batch_starts[static_cast<std::size_t>(batch)],
                vectors_.batch_starts[static_cast<std::size_t>(batch) + 1], vectors_.source_starts.data(),
                vectors_.sources.data(), vectors, sums.data());
  });
  parallel_for(pattern_->vertex_count(), kGrain, [&](int begin, int end) {
    for (int v = begin; v < end; ++v)
      g.segment<3>(3 * v) +=
          scale * sum_of_vectors(v, vectors_.target_starts.data(), vectors_.target_sums.data(), sums.data());
  });
}

void TetGather::add_matrices(double scale, BlockHessian& H, const Fill& fill) const {
  assert(&H.pattern() == pattern_.get());
  std::vector<double>& sums = H.scratch();
  sums.resize(std::max(sums.size(), 9 * matrices_.sum_count()));
  fill_batches(matrices_, matrix_size_, fill, [&](int batch, const double* matrices) {
    sum_blocks(matrices_.batch_starts[static_cast<std::size_t>(batch)],
               matrices_.batch_starts[static_cast<std::size_t>(batch) + 1], matrices_.source_starts.data(),
               matrices_.sources.data(), matrices, sums.data());
  });
  parallel_for(pattern_->block_count(), kGrain, [&](int begin, int end) {
    add_sums_of_blocks(begin, end, matrices_.target_starts.data(), matrices_.target_sums.data(), sums.data(),
                       scale, H.block(0).data());
  });
}

}  // namespace lagomorph::sim
