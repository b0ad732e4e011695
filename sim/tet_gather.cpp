#include "sim/tet_gather.h"

#include <cassert>

#include "sim/parallel.h"

namespace lagomorph::sim {

namespace {

constexpr int kGrain = 512;

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
    : pattern_(std::move(pattern)) {
  const auto size = static_cast<std::size_t>(nodes_per_element);
  std::vector<int> block_targets;
  block_targets.reserve(nodes.size() * (size + 1) / 2);
  for (std::size_t first = 0; first < nodes.size(); first += size) {
    for (std::size_t b = first; b < first + size; ++b)
      for (std::size_t a = first; a <= b; ++a) block_targets.push_back(pattern_->find(nodes[a], nodes[b]));
  }
  invert(nodes, pattern_->vertex_count(), vertex_starts_, vertex_sources_);
  invert(block_targets, pattern_->block_count(), block_starts_, block_sources_);
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

void TetGather::add_matrices(const std::vector<double>& element_matrices, double scale,
                             BlockHessian& H) const {
  assert(&H.pattern() == pattern_.get());
  parallel_for(pattern_->block_count(), kGrain, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      Mat3 sum = Mat3::Zero();
      for (int s = block_starts_[k]; s < block_starts_[k + 1]; ++s)
        sum += Eigen::Map<const Mat3>(element_matrices.data() +
                                      9 * static_cast<std::ptrdiff_t>(block_sources_[s]));
      H.block(k) += scale * sum;
    }
  });
}

}  // namespace lagomorph::sim
