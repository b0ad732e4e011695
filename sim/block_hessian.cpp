#include "sim/block_hessian.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

namespace lagomorph::sim {

BlockPattern::BlockPattern(int vertex_count, const std::vector<Tet>& tets,
                           const std::vector<Midsides>& midsides) {
  // Count the entries of each column with repeats, place them, then sort and drop the repeats.
  std::vector<std::size_t> place(static_cast<std::size_t>(vertex_count) + 1, 0);
  const auto each_pair = [&](auto&& visit) {
    for (int v = 0; v < vertex_count; ++v) visit(v, v);
    std::array<int, 10> nodes;
    for (std::size_t j = 0; j < tets.size(); ++j) {
      std::copy(tets[j].begin(), tets[j].end(), nodes.begin());
      std::size_t count = 4;
      if (!midsides.empty() && midsides[j][0] >= 0) {
        std::copy(midsides[j].begin(), midsides[j].end(), nodes.begin() + 4);
        count = 10;
      }
      for (std::size_t a = 0; a < count; ++a)
        for (std::size_t b = a + 1; b < count; ++b)
          visit(std::min(nodes[a], nodes[b]), std::max(nodes[a], nodes[b]));
    }
  };
  each_pair([&](int, int column) { ++place[static_cast<std::size_t>(column) + 1]; });
  for (std::size_t v = 0; v < place.size() - 1; ++v) place[v + 1] += place[v];
  std::vector<int> repeated(place.back());
  std::vector<std::size_t> next(place.begin(), place.end() - 1);
  each_pair([&](int row, int column) { repeated[next[static_cast<std::size_t>(column)]++] = row; });

  starts_.reserve(static_cast<std::size_t>(vertex_count) + 1);
  starts_.push_back(0);
  for (std::size_t v = 0; v + 1 < place.size(); ++v) {
    const auto begin = repeated.begin() + static_cast<std::ptrdiff_t>(place[v]);
    const auto end = repeated.begin() + static_cast<std::ptrdiff_t>(place[v + 1]);
    std::sort(begin, end);
    rows_.insert(rows_.end(), begin, std::unique(begin, end));
    starts_.push_back(static_cast<int>(rows_.size()));
  }
}

int BlockPattern::find(int i, int j) const {
  const auto begin = rows_.begin() + starts_[static_cast<std::size_t>(j)];
  const auto end = rows_.begin() + starts_[static_cast<std::size_t>(j) + 1];
  const auto it = std::lower_bound(begin, end, i);
  assert(it != end && *it == i);
  return static_cast<int>(it - rows_.begin());
}

BlockHessian::BlockHessian(std::shared_ptr<const BlockPattern> pattern)
    : pattern_(std::move(pattern)), values_(9 * static_cast<std::size_t>(pattern_->block_count()), 0.0) {}

void BlockHessian::set_zero() { std::fill(values_.begin(), values_.end(), 0.0); }

void BlockHessian::add(double scale, const BlockHessian& A) {
  for (std::size_t i = 0; i < values_.size(); ++i) values_[i] += scale * A.values_[i];
}

void BlockHessian::set_blend(const BlockHessian& A, const BlockHessian& B, double t) {
  for (std::size_t i = 0; i < values_.size(); ++i) values_[i] = (1.0 - t) * A.values_[i] + t * B.values_[i];
}

VecX BlockHessian::times(const VecX& x) const {
  VecX y = VecX::Zero(x.size());
  for (int j = 0; j < pattern_->vertex_count(); ++j) {
    for (int k = pattern_->starts()[j]; k < pattern_->starts()[j + 1]; ++k) {
      const int i = pattern_->rows()[k];
      y.segment<3>(3 * i) += block(k) * x.segment<3>(3 * j);
      if (i != j) y.segment<3>(3 * j) += block(k).transpose() * x.segment<3>(3 * i);
    }
  }
  return y;
}

VecX BlockHessian::rounding_of_times(const VecX& x) const {
  const VecX x2 = x.cwiseAbs2();
  VecX variance = VecX::Zero(x.size());
  for (int j = 0; j < pattern_->vertex_count(); ++j) {
    for (int k = pattern_->starts()[j]; k < pattern_->starts()[j + 1]; ++k) {
      const int i = pattern_->rows()[k];
      const Mat3 squared = block(k).cwiseAbs2();
      variance.segment<3>(3 * i) += squared * x2.segment<3>(3 * j);
      if (i != j) variance.segment<3>(3 * j) += squared.transpose() * x2.segment<3>(3 * i);
    }
  }
  return 0.5 * std::numeric_limits<double>::epsilon() * variance.cwiseSqrt();
}

SparseMatrix BlockHessian::to_sparse() const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * values_.size());
  for (int j = 0; j < pattern_->vertex_count(); ++j) {
    for (int k = pattern_->starts()[j]; k < pattern_->starts()[j + 1]; ++k) {
      const int i = pattern_->rows()[k];
      for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) {
          entries.emplace_back(3 * i + r, 3 * j + c, block(k)(r, c));
          if (i != j) entries.emplace_back(3 * j + c, 3 * i + r, block(k)(r, c));
        }
      }
    }
  }
  const int n = 3 * pattern_->vertex_count();
  SparseMatrix H(n, n);
  H.setFromTriplets(entries.begin(), entries.end());
  return H;
}

}  // namespace lagomorph::sim
