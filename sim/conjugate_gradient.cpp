#include "sim/conjugate_gradient.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include <Eigen/LU>

#include "sim/parallel.h"
#include "sim/profile.h"
#include "sim/simd.h"

namespace lagomorph::sim {

namespace {

constexpr int kCoordinates = 1 << 14;  // of a piece of a vector

}  // namespace

CgReport conjugate_gradients(CgSystem& system, const VecX& b, const CgLimits& limits, VecX& x) {
  CgReport report;
  x.setZero(b.size());
  VecX r = b, z(b.size()), p = VecX::Zero(b.size()), y = VecX::Zero(b.size());
  const double b_norm = b.norm();
  if (b_norm == 0.0) return report;
  double rz = system.update(0.0, p, y, x, r, z).rz;
  p = z;
  for (;;) {
    const double curvature = system.times(p, y);
    if (!(curvature > 0.0)) {
      report.status = CgStatus::negative_curvature;
      return report;
    }
    const CgSystem::Products next = system.update(rz / curvature, p, y, x, r, z);
    report.residual = std::sqrt(next.rr) / b_norm;
    ++report.iterations;
    if (report.residual <= limits.tolerance) return report;
    bool hopeless = report.iterations >= limits.max_iterations || !(next.rz > 0.0);
    if (limits.probe > 0 && report.iterations % limits.probe == 0) {
      const double rate = std::log(std::min(report.residual, 0.99)) / report.iterations;
      const double patience = 1.5 + 1.5 * limits.probe / report.iterations;
      hopeless |= std::log(limits.goal) / rate > patience * limits.budget;
    }
    if (hopeless) {
      report.status = CgStatus::gave_up;
      return report;
    }
    const double beta = next.rz / rz;
    parallel_for(static_cast<int>(p.size()), kCoordinates, [&](int begin, int end) {
      p.segment(begin, end - begin) = z.segment(begin, end - begin) + beta * p.segment(begin, end - begin);
    });
    rz = next.rz;
  }
}

namespace {

constexpr int kRows = 256;  // of a piece of work; sums are made piece by piece, whatever the threads

constexpr double kSameResidual = 1.001;  // over the tolerance, that is taken for it

using Double4 = double __attribute__((vector_size(32), aligned(8)));
using Float4 = float __attribute__((vector_size(16), aligned(4), may_alias));

// What a matrix's numbers are, and four of them.
struct Full {
  using Number = double;
  using Four = Double4;
};
struct Rounded {
  using Number = float;
  using Four = Float4;
};

/// Rows [begin, end) of y = A x, with x a copy of p in A's precision; returns their part of pᵀ y. Of each
/// block's columns four numbers are read, the fourth of no use.
template <class Precision>
inline __attribute__((always_inline)) double multiply(int begin, int end, const int* starts,
                                                      const int* columns,
                                                      const typename Precision::Number* values,
                                                      const typename Precision::Number* x, const double* p,
                                                      double* y) {
  Double4 sum = {};
  for (int i = begin; i < end; ++i) {
    typename Precision::Four a = {}, b = {}, c = {};
    for (int k = starts[i]; k < starts[i + 1]; ++k) {
      const auto* block = values + 9 * static_cast<std::ptrdiff_t>(k);
      const auto* of = x + 3 * static_cast<std::ptrdiff_t>(columns[k]);
      a += *reinterpret_cast<const typename Precision::Four*>(block) * of[0];
      b += *reinterpret_cast<const typename Precision::Four*>(block + 3) * of[1];
      c += *reinterpret_cast<const typename Precision::Four*>(block + 6) * of[2];
    }
    a += b + c;
    const Double4 full = __builtin_convertvector(a, Double4);
    const std::ptrdiff_t at = 3 * static_cast<std::ptrdiff_t>(i);
    for (int r = 0; r < 3; ++r) y[at + r] = full[r];
    sum += full * Double4{p[at], p[at + 1], p[at + 2], 0.0};
  }
  return sum[0] + sum[1] + sum[2];
}

LAGOMORPH_SIMD double multiply_rows(int begin, int end, const int* starts, const int* columns,
                                    const double* values, const double* p, double* y) {
  return multiply<Full>(begin, end, starts, columns, values, p, p, y);
}

LAGOMORPH_SIMD double multiply_rounded_rows(int begin, int end, const int* starts, const int* columns,
                                            const float* values, const float* rounded_p, const double* p,
                                            double* y) {
  return multiply<Rounded>(begin, end, starts, columns, values, rounded_p, p, y);
}

/// x += alpha p, r -= alpha y, z = D⁻¹ r for vertices [begin, end).
LAGOMORPH_SIMD CgSystem::Products update_rows(int begin, int end, double alpha, const double* inverses,
                                              const double* p, const double* y, double* x, double* r,
                                              double* z) {
  for (std::ptrdiff_t at = 3 * static_cast<std::ptrdiff_t>(begin); at < 3 * static_cast<std::ptrdiff_t>(end);
       ++at) {
    x[at] += alpha * p[at];
    r[at] -= alpha * y[at];
  }
  Double4 rr = {0.0, 0.0, 0.0, 0.0};
  Double4 rz = rr;
  for (int i = begin; i < end; ++i) {
    const double* d = inverses + 9 * static_cast<std::ptrdiff_t>(i);
    const std::ptrdiff_t at = 3 * static_cast<std::ptrdiff_t>(i);
    const Double4 ri = {r[at], r[at + 1], r[at + 2], 0.0};
    const Double4 zi = *reinterpret_cast<const Double4*>(d) * ri[0] +
                       *reinterpret_cast<const Double4*>(d + 3) * ri[1] +
                       *reinterpret_cast<const Double4*>(d + 6) * ri[2];
    for (int k = 0; k < 3; ++k) z[at + k] = zi[k];
    rr += ri * ri;
    rz += ri * zi;
  }
  return {rr[0] + rr[1] + rr[2], rz[0] + rz[1] + rz[2]};
}

/// Neighbours of each free vertex, by their places among the free ones, ascending.
struct Graph {
  std::vector<int> starts, neighbours;
  int degree(int v) const {
    return starts[static_cast<std::size_t>(v) + 1] - starts[static_cast<std::size_t>(v)];
  }
  template <class Visit>
  void each_neighbour(int v, Visit&& visit) const {
    for (int k = starts[static_cast<std::size_t>(v)]; k < starts[static_cast<std::size_t>(v) + 1]; ++k)
      visit(neighbours[static_cast<std::size_t>(k)]);
  }
};

template <class Visit>
void each_free_pair(const BlockPattern& pattern, const Pins& pins, Visit&& visit) {
  for (const int j : pins.free_vertices()) {
    for (int k = pattern.starts()[static_cast<std::size_t>(j)];
         k < pattern.starts()[static_cast<std::size_t>(j) + 1]; ++k) {
      const int i = pins.free_index(pattern.rows()[static_cast<std::size_t>(k)]);
      if (i >= 0) visit(i, pins.free_index(j), k);
    }
  }
}

Graph graph_of(const BlockPattern& pattern, const Pins& pins) {
  Graph graph;
  graph.starts.assign(pins.free_vertices().size() + 1, 0);
  each_free_pair(pattern, pins, [&](int i, int j, int) {
    if (i == j) return;
    ++graph.starts[static_cast<std::size_t>(i) + 1];
    ++graph.starts[static_cast<std::size_t>(j) + 1];
  });
  for (std::size_t v = 0; v + 1 < graph.starts.size(); ++v) graph.starts[v + 1] += graph.starts[v];
  graph.neighbours.resize(static_cast<std::size_t>(graph.starts.back()));
  std::vector<int> next(graph.starts.begin(), graph.starts.end() - 1);
  each_free_pair(pattern, pins, [&](int i, int j, int) {
    if (i == j) return;
    graph.neighbours[static_cast<std::size_t>(next[static_cast<std::size_t>(i)]++)] = j;
    graph.neighbours[static_cast<std::size_t>(next[static_cast<std::size_t>(j)]++)] = i;
  });
  return graph;
}

/// Breadth first from each part's vertex of least degree, those of small degree before others. [Cuthill and
/// McKee 1969]
std::vector<int> cuthill_mckee(const Graph& graph) {
  const std::size_t n = graph.starts.size() - 1;
  std::vector<int> by_degree(n), order;
  for (std::size_t v = 0; v < n; ++v) by_degree[v] = static_cast<int>(v);
  std::stable_sort(by_degree.begin(), by_degree.end(),
                   [&](int a, int b) { return graph.degree(a) < graph.degree(b); });
  std::vector<char> seen(n, 0);
  order.reserve(n);
  const auto take = [&](int v) {
    if (seen[static_cast<std::size_t>(v)] != 0) return;
    seen[static_cast<std::size_t>(v)] = 1;
    order.push_back(v);
  };
  for (const int root : by_degree) {
    std::size_t next = order.size();
    take(root);
    for (; next < order.size(); ++next) {
      const std::size_t first = order.size();
      graph.each_neighbour(order[next], take);
      std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(first), order.end(),
                       [&](int a, int b) { return graph.degree(a) < graph.degree(b); });
    }
  }
  return order;
}

/// Inverse of a diagonal block over the free axes, zero elsewhere. False when it is not positive definite.
bool invert_diagonal(const double* block, unsigned free, double* inverse) {
  Mat3 A = Eigen::Map<const Mat3>(block);
  for (int k = 0; k < 3; ++k)
    if ((free >> k & 1U) == 0) A(k, k) = 1.0;
  const double minor = A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0);
  if (!(A(0, 0) > 0.0) || !(minor > 0.0) || !(A.determinant() > 0.0)) return false;
  Eigen::Map<Mat3> D(inverse);
  D = A.inverse();
  for (int k = 0; k < 3; ++k) {
    if ((free >> k & 1U) != 0) continue;
    D.row(k).setZero();
    D.col(k).setZero();
  }
  return true;
}

}  // namespace

class BlockJacobiCg::System : public CgSystem {
public:
  enum class Precision { single, full };
  System(const BlockJacobiCg& a, Precision precision)
      : a_(a), precision_(precision), sums_(static_cast<std::size_t>(pieces(a))) {
    if (precision == Precision::single) rounded_p_.resize(3 * a.vertices_.size());
  }

  double times(const VecX& p, VecX& y) override {
    if (precision_ == Precision::full) {
      return sum_of_pieces([&](int begin, int end) {
               return Products{0.0, multiply_rows(begin, end, a_.starts_.data(), a_.columns_.data(),
                                                  a_.values_.data(), p.data(), y.data())};
             })
          .rz;
    }
    parallel_for(static_cast<int>(p.size()), kCoordinates, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) rounded_p_[static_cast<std::size_t>(i)] = static_cast<float>(p[i]);
    });
    return sum_of_pieces([&](int begin, int end) {
             return Products{
                 0.0, multiply_rounded_rows(begin, end, a_.starts_.data(), a_.columns_.data(),
                                            a_.rounded_.data(), rounded_p_.data(), p.data(), y.data())};
           })
        .rz;
  }
  Products update(double alpha, const VecX& p, const VecX& y, VecX& x, VecX& r, VecX& z) override {
    return sum_of_pieces([&](int begin, int end) {
      return update_rows(begin, end, alpha, a_.inverses_.data(), p.data(), y.data(), x.data(), r.data(),
                         z.data());
    });
  }

  static int pieces(const BlockJacobiCg& a) { return (a.row_count() + kRows - 1) / kRows; }
  /// Rows [begin, end) of a piece.
  static std::pair<int, int> rows(const BlockJacobiCg& a, int piece) {
    return {piece * kRows, std::min((piece + 1) * kRows, a.row_count())};
  }

private:
  template <class Work>
  Products sum_of_pieces(Work&& work) {
    parallel_for(static_cast<int>(sums_.size()), 1, [&](int first, int last) {
      for (int piece = first; piece < last; ++piece) {
        const auto [begin, end] = rows(a_, piece);
        sums_[static_cast<std::size_t>(piece)] = work(begin, end);
      }
    });
    Products total;
    for (const Products& s : sums_) {
      total.rr += s.rr;
      total.rz += s.rz;
    }
    return total;
  }

  const BlockJacobiCg& a_;
  Precision precision_;
  std::vector<float> rounded_p_;
  std::vector<Products> sums_;  // of each piece
};

void BlockJacobiCg::analyze(std::shared_ptr<const BlockPattern> pattern, const Pins& pins) {
  const Timed timed(Stage::analysis);
  pattern_ = std::move(pattern);
  const std::vector<int> order = cuthill_mckee(graph_of(*pattern_, pins));
  std::vector<int> place(order.size());
  vertices_.clear();
  free_axes_.clear();
  for (std::size_t p = 0; p < order.size(); ++p) {
    place[static_cast<std::size_t>(order[p])] = static_cast<int>(p);
    const int v = pins.free_vertices()[static_cast<std::size_t>(order[p])];
    vertices_.push_back(v);
    unsigned axes = 0;
    for (int k = 0; k < 3; ++k) axes |= pins.is_held(3 * v + k) ? 0U : 1U << k;
    free_axes_.push_back(static_cast<unsigned char>(axes));
  }
  const auto placed = [&](int i) { return static_cast<std::size_t>(place[static_cast<std::size_t>(i)]); };
  starts_.assign(order.size() + 1, 0);
  each_free_pair(*pattern_, pins, [&](int i, int j, int) {
    ++starts_[placed(i) + 1];
    if (i != j) ++starts_[placed(j) + 1];
  });
  for (std::size_t row = 0; row + 1 < starts_.size(); ++row) starts_[row + 1] += starts_[row];
  std::vector<std::pair<int, int>> entries(static_cast<std::size_t>(starts_.back()));  // column, source
  std::vector<int> next(starts_.begin(), starts_.end() - 1);
  const auto add = [&](std::size_t row, std::size_t column, int source) {
    entries[static_cast<std::size_t>(next[row]++)] = {static_cast<int>(column), source};
  };
  each_free_pair(*pattern_, pins, [&](int i, int j, int block) {
    add(placed(i), placed(j), block);
    if (i != j) add(placed(j), placed(i), ~block);
  });
  columns_.resize(entries.size());
  sources_.resize(entries.size());
  for (std::size_t row = 0; row + 1 < starts_.size(); ++row) {
    std::sort(entries.begin() + starts_[row], entries.begin() + starts_[row + 1]);
    for (auto k = static_cast<std::size_t>(starts_[row]); k < static_cast<std::size_t>(starts_[row + 1]); ++k)
      std::tie(columns_[k], sources_[k]) = entries[k];
  }
  values_.assign(9 * columns_.size() + 1, 0.0);
  rounded_.assign(9 * columns_.size() + 3, 0.0F);
  inverses_.assign(9 * order.size() + 1, 0.0);
}

bool BlockJacobiCg::set_matrix(const BlockHessian& H) {
  const Timed timed(Stage::solve);
  std::vector<char> is_bad(static_cast<std::size_t>(System::pieces(*this)), 0);
  parallel_for(System::pieces(*this), 1, [&](int first, int last) {
    for (int piece = first; piece < last; ++piece) {
      const auto [begin, end] = System::rows(*this, piece);
      for (int row = begin; row < end; ++row)
        if (!set_row(H, static_cast<std::size_t>(row))) is_bad[static_cast<std::size_t>(piece)] = 1;
    }
  });
  return std::find(is_bad.begin(), is_bad.end(), 1) == is_bad.end();
}

bool BlockJacobiCg::set_row(const BlockHessian& H, std::size_t row) {
  const unsigned free_rows = free_axes_[row];
  for (auto k = static_cast<std::size_t>(starts_[row]); k < static_cast<std::size_t>(starts_[row + 1]); ++k) {
    const int source = sources_[k];
    const auto column = static_cast<std::size_t>(columns_[k]);
    Eigen::Map<Mat3> block(values_.data() + 9 * k);
    if (row == column) {
      block = H.block(source).selfadjointView<Eigen::Upper>();
    } else if (source < 0) {
      block = H.block(~source).transpose();
    } else {
      block = H.block(source);
    }
    const unsigned free_columns = free_axes_[column];
    if ((free_rows & free_columns) != 7U) {
      for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
          if ((free_rows >> r & free_columns >> c & 1U) == 0) block(r, c) = 0.0;
    }
    for (std::size_t i = 9 * k; i < 9 * (k + 1); ++i) rounded_[i] = static_cast<float>(values_[i]);
    if (row == column && !invert_diagonal(block.data(), free_rows, inverses_.data() + 9 * row)) return false;
  }
  return true;
}

CgReport BlockJacobiCg::solve(const VecX& b, const CgLimits& limits, VecX& x) {
  const Timed timed(Stage::solve);
  VecX rhs(3 * static_cast<Eigen::Index>(vertices_.size())), solution;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    for (int k = 0; k < 3; ++k)
      rhs[3 * static_cast<Eigen::Index>(i) + k] =
          (free_axes_[i] >> k & 1) != 0 ? b[3 * vertices_[i] + k] : 0.0;
  }
  System rounded(*this, System::Precision::single), full(*this, System::Precision::full);
  CgReport report = conjugate_gradients(rounded, rhs, limits, solution);
  const auto go_on = [&](const VecX& from, double tolerance) {
    CgLimits rest = limits;
    rest.tolerance = tolerance;
    rest.goal = std::min(limits.goal * tolerance / limits.tolerance, 0.99);
    rest.max_iterations = std::max(limits.max_iterations - report.iterations, 1);
    VecX correction;
    const CgReport more = conjugate_gradients(full, from, rest, correction);
    report = {more.status, report.iterations + more.iterations, more.residual * from.norm() / rhs.norm()};
    return correction;
  };
  if (report.status == CgStatus::negative_curvature) {
    solution = go_on(rhs, limits.tolerance);
  } else if (report.status == CgStatus::converged && report.iterations > 0) {
    VecX r(rhs.size());
    full.times(solution, r);
    r = rhs - r;
    report.residual = r.norm() / rhs.norm();
    if (report.residual > kSameResidual * limits.tolerance)
      solution += go_on(r, limits.tolerance / report.residual);
  }
  x.setZero(b.size());
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    x.segment<3>(3 * vertices_[i]) = solution.segment<3>(3 * static_cast<Eigen::Index>(i));
  return report;
}

}  // namespace lagomorph::sim
