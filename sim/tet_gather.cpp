#include "sim/tet_gather.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "sim/parallel.h"

namespace lagomorph::sim {

namespace {

constexpr int kGrain = 512;
constexpr int kBatch = 512;  // elements: of linear tets, 360 kB of matrices
constexpr int kFilled = 64;  // elements a task

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
      element_count_(static_cast<int>(nodes.size()) / nodes_per_element) {
  invert(nodes, pattern_->vertex_count(), vertex_starts_, vertex_sources_);
  const auto size = static_cast<std::size_t>(nodes_per_element);
  batch_starts_.push_back(0);
  std::vector<std::pair<int, int>> additions;  // block, source within the batch
  for (int first = 0; first < element_count_; first += kBatch) {
    additions.clear();
    const auto last = static_cast<std::size_t>(std::min(first + kBatch, element_count_));
    for (std::size_t j = static_cast<std::size_t>(first); j < last; ++j) {
      for (std::size_t b = 0; b < size; ++b)
        for (std::size_t a = 0; a <= b; ++a)
          additions.emplace_back(pattern_->find(nodes[size * j + a], nodes[size * j + b]),
                                 static_cast<int>(additions.size()));
    }
    std::sort(additions.begin(), additions.end());
    for (const auto& [block, source] : additions) {
      if (static_cast<int>(targets_.size()) == batch_starts_.back() || targets_.back() != block) {
        targets_.push_back(block);
        source_starts_.push_back(static_cast<int>(sources_.size()));
      }
      sources_.push_back(source);
    }
    batch_starts_.push_back(static_cast<int>(targets_.size()));
  }
  source_starts_.push_back(static_cast<int>(sources_.size()));
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
  std::vector<double>& matrices = H.scratch();
  matrices.resize(std::max(matrices.size(), matrix_size_ * static_cast<std::size_t>(kBatch)));
  for (std::size_t batch = 0; batch + 1 < batch_starts_.size(); ++batch) {
    const int first = static_cast<int>(batch) * kBatch;
    parallel_for(std::min(kBatch, element_count_ - first), kFilled, [&](int begin, int end) {
      fill(first + begin, first + end, matrices.data() + matrix_size_ * static_cast<std::size_t>(begin));
    });
    const int first_target = batch_starts_[batch];
    parallel_for(batch_starts_[batch + 1] - first_target, kGrain, [&](int begin, int end) {
      for (int t = first_target + begin; t < first_target + end; ++t) {
        Mat3 sum = Mat3::Zero();
        for (int s = source_starts_[static_cast<std::size_t>(t)];
             s < source_starts_[static_cast<std::size_t>(t) + 1]; ++s)
          sum += Eigen::Map<const Mat3>(
              matrices.data() + 9 * static_cast<std::ptrdiff_t>(sources_[static_cast<std::size_t>(s)]));
        H.block(targets_[static_cast<std::size_t>(t)]) += scale * sum;
      }
    });
  }
}

}  // namespace lagomorph::sim
