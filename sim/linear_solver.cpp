#include "sim/linear_solver.h"

#include <array>
#include <atomic>
#include <filesystem>
#include <new>
#include <stdexcept>

#include <cblas.h>
#include <cholmod.h>
#include <dlfcn.h>
#include <omp.h>

#include "sim/parallel.h"
#include "sim/profile.h"

namespace lagomorph::sim {

namespace {

std::atomic<int> blas_threads_in_use = 1;

/// While it lives, OpenBLAS has the threads asked for, and CHOLMOD's own parallel regions have one: their
/// number is compiled in (`num_threads(4)`), so that only a bound on the levels of parallelism reaches them.
class Threads {
public:
  explicit Threads(int blas_threads) : levels_(omp_get_max_active_levels()) {
    omp_set_max_active_levels(0);
    openblas_set_num_threads(blas_threads);
    blas_threads_in_use = blas_threads;
  }
  ~Threads() { omp_set_max_active_levels(levels_); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

private:
  int levels_;
};

/// A sparse matrix whose arrays are ours; CHOLMOD sees a view of them.
struct Columns {
  std::vector<SuiteSparse_long> starts, rows;
  std::vector<double> values;

  cholmod_sparse view(int stype) {
    cholmod_sparse A{};
    A.nrow = A.ncol = starts.size() - 1;
    A.nzmax = rows.size();
    A.p = starts.data();
    A.i = rows.data();
    A.x = values.data();
    A.stype = stype;
    A.itype = CHOLMOD_LONG;
    A.xtype = values.empty() ? CHOLMOD_PATTERN : CHOLMOD_REAL;
    A.dtype = CHOLMOD_DOUBLE;
    A.sorted = 1;
    A.packed = 1;
    return A;
  }
};

}  // namespace

struct LinearSolver::Implementation {
  explicit Implementation(int threads) : blas_threads(threads) {
    cholmod_l_start(&common);
    common.print = 0;  // a matrix that is not positive definite is told by a status, not on stderr
    common.error_handler = nullptr;
    common.quick_return_if_not_posdef = 1;
    // Three coordinates a vertex: supernodes of twice CHOLMOD's widths are merged though it adds zeros; 5 to
    // 8 % faster.
    common.nrelax[0] = 8;
    common.nrelax[1] = 32;
    common.nrelax[2] = 96;
  }
  ~Implementation() {
    free_factors();
    cholmod_l_finish(&common);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void free_factors() {
    cholmod_l_free_factor(&cholesky, &common);
    cholmod_l_free_factor(&ldlt, &common);
    cholmod_l_free_dense(&x, &common);
    cholmod_l_free_dense(&y, &common);
    cholmod_l_free_dense(&e, &common);
    solving = nullptr;
  }

  void order_vertices(const Pins& pins);
  void lay_out(const Pins& pins);
  cholmod_factor* analyze_in_place(int supernodal);
  void fill(const BlockHessian& H);
  FactorStatus factorize(const BlockHessian& H, cholmod_factor* factor);
  /// Visits the free coordinates: place in the system, and among the 3n.
  template <class Visit>
  void each_coordinate(Visit&& visit) const {
    for (const FreeVertex& free : order)
      for (int k = 0; k < free.count; ++k)
        visit(free.first + k, 3 * free.vertex + free.axes[static_cast<std::size_t>(k)]);
  }

  int blas_threads;
  cholmod_common common{};
  cholmod_factor* cholesky = nullptr;
  cholmod_factor* ldlt = nullptr;                          // made when first asked for
  cholmod_factor* solving = nullptr;                       // the one that solve() uses
  cholmod_dense *x = nullptr, *y = nullptr, *e = nullptr;  // kept between solves

  std::shared_ptr<const BlockPattern> pattern;
  /// A vertex that has free coordinates.
  struct FreeVertex {
    int vertex = 0;
    int first = 0;                        // place of its first free coordinate in the system
    int count = 0;                        // how many are free, 1 to 3
    std::array<int, 3> axes = {0, 1, 2};  // which, ascending
  };
  std::vector<FreeVertex> order;  // in their order of elimination
  std::vector<int> place;         // of each vertex in `order`, -1 when pinned
  Columns lower;  // lower triangle of the system in that order: CHOLMOD factorizes it as it lies
  struct BlockPlace {
    int row = -1, column = -1;  // places of its vertices in `order`, row >= column; -1: not in the system
    int before = 0;             // scalar rows of the column's first coordinate that come before it
    bool transposed = false;
  };
  std::vector<BlockPlace> block_places;
  VecX rhs;
  double nonzeros = 0.0, flops = 0.0;
};

/// Orders the free vertices, not their coordinates: a graph nine times smaller, and the three stay together.
/// Takes the better of minimum degree and nested dissection.
void LinearSolver::Implementation::order_vertices(const Pins& pins) {
  Columns graph;
  graph.starts.push_back(0);
  for (const int j : pins.free_vertices()) {
    for (int k = pattern->starts()[j]; k < pattern->starts()[j + 1]; ++k) {
      const int i = pins.free_index(pattern->rows()[k]);
      if (i >= 0) graph.rows.push_back(i);
    }
    graph.starts.push_back(static_cast<SuiteSparse_long>(graph.rows.size()));
  }
  cholmod_sparse A = graph.view(1);
  common.nmethods = 2;
  common.method[0].ordering = CHOLMOD_AMD;
  common.method[1].ordering = CHOLMOD_METIS;
  common.postorder = 1;
  common.supernodal = CHOLMOD_SIMPLICIAL;
  cholmod_factor* factor = cholmod_l_analyze(&A, &common);
  if (factor == nullptr) throw std::bad_alloc();
  const auto* permutation = static_cast<const SuiteSparse_long*>(factor->Perm);
  order.clear();
  place.assign(static_cast<std::size_t>(pattern->vertex_count()), -1);
  for (std::size_t p = 0; p < A.nrow; ++p) {
    const int vertex = pins.free_vertices()[static_cast<std::size_t>(permutation[p])];
    place[static_cast<std::size_t>(vertex)] = static_cast<int>(p);
    FreeVertex free{vertex, order.empty() ? 0 : order.back().first + order.back().count};
    for (int k = 0; k < 3; ++k)
      if (!pins.is_held(3 * vertex + k)) free.axes[static_cast<std::size_t>(free.count++)] = k;
    order.push_back(free);
  }
  cholmod_l_free_factor(&factor, &common);
}

/// Finds where each block of the pattern goes in the lower triangle of the ordered system.
void LinearSolver::Implementation::lay_out(const Pins& pins) {
  struct Entry {
    int row, block;
    bool transposed;
  };
  std::vector<std::vector<Entry>> columns(order.size());
  for (const int j : pins.free_vertices()) {
    for (int k = pattern->starts()[j]; k < pattern->starts()[j + 1]; ++k) {
      const int pi = place[static_cast<std::size_t>(pattern->rows()[k])],
                pj = place[static_cast<std::size_t>(j)];
      if (pi < 0) continue;
      columns[static_cast<std::size_t>(std::min(pi, pj))].push_back({std::max(pi, pj), k, pi < pj});
    }
  }
  block_places.assign(static_cast<std::size_t>(pattern->block_count()), BlockPlace{});
  lower = Columns{};
  lower.starts.push_back(0);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    std::vector<Entry>& entries = columns[c];
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.row < b.row; });
    int before = 0;
    for (const Entry& entry : entries) {
      block_places[static_cast<std::size_t>(entry.block)] = {entry.row, static_cast<int>(c), before,
                                                             entry.transposed};
      before += order[static_cast<std::size_t>(entry.row)].count;
    }
    for (int k = 0; k < order[c].count; ++k) {
      for (const Entry& entry : entries) {
        const FreeVertex& row = order[static_cast<std::size_t>(entry.row)];
        for (int r = entry.row == static_cast<int>(c) ? k : 0; r < row.count; ++r)
          lower.rows.push_back(row.first + r);
      }
      lower.starts.push_back(static_cast<SuiteSparse_long>(lower.rows.size()));
    }
  }
  lower.values.assign(lower.rows.size(), 0.0);
}

cholmod_factor* LinearSolver::Implementation::analyze_in_place(int supernodal) {
  cholmod_sparse A = lower.view(-1);
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_NATURAL;
  common.postorder = 0;
  common.supernodal = supernodal;
  common.final_ll = supernodal == CHOLMOD_SUPERNODAL;
  cholmod_factor* factor = cholmod_l_analyze(&A, &common);
  if (factor == nullptr) throw std::bad_alloc();
  return factor;
}

void LinearSolver::Implementation::fill(const BlockHessian& H) {
  parallel_for(pattern->block_count(), 1024, [&](int begin, int end) {
    for (int b = begin; b < end; ++b) {
      const BlockPlace& where = block_places[static_cast<std::size_t>(b)];
      if (where.column < 0) continue;
      const auto block = H.block(b);
      const FreeVertex& row = order[static_cast<std::size_t>(where.row)];
      const FreeVertex& column = order[static_cast<std::size_t>(where.column)];
      for (int k = 0; k < column.count; ++k) {
        const int place = column.first + k;
        // Each column begins at its diagonal, so that the k-th has k rows less.
        double* values =
            lower.values.data() + lower.starts[static_cast<std::size_t>(place)] + where.before - k;
        const int axis = column.axes[static_cast<std::size_t>(k)];
        for (int r = where.row == where.column ? k : 0; r < row.count; ++r) {
          const int row_axis = row.axes[static_cast<std::size_t>(r)];
          values[r] =
              where.transposed || where.row == where.column ? block(axis, row_axis) : block(row_axis, axis);
        }
      }
    }
  });
}

FactorStatus LinearSolver::Implementation::factorize(const BlockHessian& H, cholmod_factor* factor) {
  const Timed timed(Stage::factorization);
  const Threads threads(blas_threads);
  solving = nullptr;
  fill(H);
  cholmod_sparse A = lower.view(-1);
  cholmod_l_factorize(&A, factor, &common);
  if (common.status < CHOLMOD_OK) return FactorStatus::out_of_memory;
  if (common.status == CHOLMOD_NOT_POSDEF || factor->minor < factor->n)
    return FactorStatus::not_positive_definite;
  solving = factor;
  return FactorStatus::ok;
}

LinearSolver::LinearSolver(int blas_threads)
    : implementation_(std::make_unique<Implementation>(blas_threads)) {}
LinearSolver::~LinearSolver() = default;
LinearSolver::LinearSolver(LinearSolver&&) noexcept = default;
LinearSolver& LinearSolver::operator=(LinearSolver&&) noexcept = default;

void LinearSolver::analyze(std::shared_ptr<const BlockPattern> pattern, const Pins& pins) {
  Implementation& s = *implementation_;
  const Timed timed(Stage::analysis);
  s.free_factors();
  s.pattern = std::move(pattern);
  s.order.clear();
  s.nonzeros = s.flops = 0.0;
  if (pins.free_dofs() == 0) return;
  const Threads threads(s.blas_threads);
  s.order_vertices(pins);
  s.lay_out(pins);
  s.cholesky = s.analyze_in_place(CHOLMOD_SUPERNODAL);
  s.nonzeros = s.common.lnz;
  s.flops = s.common.fl;
  s.rhs.resize(pins.free_dofs());
}

FactorStatus LinearSolver::factorize(const BlockHessian& H) {
  Implementation& s = *implementation_;
  return s.order.empty() ? FactorStatus::ok : s.factorize(H, s.cholesky);
}

FactorStatus LinearSolver::factorize_indefinite(const BlockHessian& H) {
  Implementation& s = *implementation_;
  if (s.order.empty()) return FactorStatus::ok;
  if (s.ldlt == nullptr) s.ldlt = s.analyze_in_place(CHOLMOD_SIMPLICIAL);
  return s.factorize(H, s.ldlt);
}

void LinearSolver::solve(const VecX& b, VecX& x) {
  Implementation& s = *implementation_;
  x.setZero(b.size());
  if (s.order.empty()) return;
  if (s.solving == nullptr) throw std::logic_error("LinearSolver::solve without a factor");
  const Timed timed(Stage::solve);
  const Threads threads(s.blas_threads);
  s.each_coordinate([&](int place, int dof) { s.rhs[place] = b[dof]; });
  cholmod_dense rhs{};
  rhs.nrow = rhs.nzmax = rhs.d = static_cast<std::size_t>(s.rhs.size());
  rhs.ncol = 1;
  rhs.x = s.rhs.data();
  rhs.xtype = CHOLMOD_REAL;
  rhs.dtype = CHOLMOD_DOUBLE;
  if (!cholmod_l_solve2(CHOLMOD_A, s.solving, &rhs, nullptr, &s.x, nullptr, &s.y, &s.e, &s.common))
    throw std::bad_alloc();
  const Eigen::Map<const VecX> solution(static_cast<const double*>(s.x->x), s.rhs.size());
  s.each_coordinate([&](int place, int dof) { x[dof] = solution[place]; });
}

double LinearSolver::factor_nonzeros() const { return implementation_->nonzeros; }
double LinearSolver::factor_flops() const { return implementation_->flops; }

std::string blas_kernel() { return openblas_get_corename(); }

LinearAlgebraInfo linear_algebra_info() {
  LinearAlgebraInfo info;
  int version[3];
  cholmod_l_version(version);
  info.cholmod =
      std::to_string(version[0]) + "." + std::to_string(version[1]) + "." + std::to_string(version[2]);
  info.blas = openblas_get_config();
  info.blas_kernel = blas_kernel();
  info.blas_threads = blas_threads_in_use;
  // The dynamic linker gives CHOLMOD the first dpotrf_ in the order of loading: ask it for the same.
  if (void* symbol = dlsym(RTLD_DEFAULT, "dpotrf_"); symbol != nullptr) {
    Dl_info where{};
    if (dladdr(symbol, &where) != 0 && where.dli_fname != nullptr) {
      info.blas_library = std::filesystem::weakly_canonical(where.dli_fname).string();
      info.blas_is_openblas = info.blas_library.find("openblas") != std::string::npos;
    }
  }
  return info;
}

}  // namespace lagomorph::sim
