#include "sim/system_solver.h"

#include <algorithm>
#include <cmath>

namespace lagomorph::sim {

namespace {

// Weights of the work, in nanoseconds on the machine that they were taken on (Intel Xeon, two threads,
// OpenBLAS's AVX-512 kernel): only their ratios matter.
constexpr double kPerBlock = 2.2;            // of a product and the vectors of an iteration
constexpr double kPerFlop = 0.03;            // of a factorization
constexpr double kPerNonzero = 8.0;          // of a factorization, besides its operations
constexpr double kPerNonzeroOfSolve = 0.95;  // of forward and backward substitution

/// Of a bunny's factor in n free vertices by nested dissection, within a factor of two from 1,000 to 40,000.
double expected_flops(double n) { return 60.0 * n * n; }
double expected_nonzeros(double n) { return 34.0 * std::pow(n, 4.0 / 3.0); }

constexpr double kSolves = 5.0;              // with a factor that a minimization takes until its end
constexpr double kFewestIterations = 100.0;  // that a factorization must cost for CG to be tried at all
constexpr int kMostIterations = 20000;
constexpr double kTrialTolerance = 1e-3, kTrials = 2.2;  // of these a minimization to 3e-7 is made

/// H preconditioned by a factor of another matrix.
class FactorCg : public CgSystem {
public:
  FactorCg(const BlockHessian& H, const Pins& pins, LinearSolver& factor)
      : H_(H), pins_(pins), factor_(factor) {}
  double times(const VecX& p, VecX& y) override {
    y = H_.times(p);
    pins_.clear_pinned(y);
    return p.dot(y);
  }
  Products update(double alpha, const VecX& p, const VecX& y, VecX& x, VecX& r, VecX& z) override {
    x += alpha * p;
    r -= alpha * y;
    factor_.solve(r, z);
    return {r.squaredNorm(), r.dot(z)};
  }

private:
  const BlockHessian& H_;
  const Pins& pins_;
  LinearSolver& factor_;
};

}  // namespace

SystemSolver::SystemSolver(const SolverSettings& settings)
    : may_factorize_(settings.linear != "cg"),
      may_iterate_(settings.linear != "cholmod"),
      factor_(settings.blas_threads) {}

void SystemSolver::analyze(std::shared_ptr<const BlockPattern> pattern, const Pins& pins) {
  pattern_ = std::move(pattern);
  pins_ = &pins;
  cg_ = BlockJacobiCg();
  factor_is_analyzed_ = false;
  trials_.clear();
}

bool SystemSolver::needs_trial(double m) const {
  if (!may_choose() || m == 0.0 || cg_budget() < kFewestIterations) return false;
  return std::none_of(trials_.begin(), trials_.end(), [&](const Trial& t) { return t.m == m; });
}

void SystemSolver::try_at_rest(double m, const BlockHessian& H, const VecX& b) {
  if (!cg_.is_analyzed()) cg_.analyze(pattern_, *pins_);
  Way way = Way::cg;
  if (cg_.set_matrix(H)) {
    VecX x;
    const int most = static_cast<int>(std::min<double>(cg_budget() / kTrials, kMostIterations));
    if (cg_.solve(b, {kTrialTolerance, most}, x).status == CgStatus::gave_up) way = Way::factor;
  }
  trials_.push_back({m, way});
}

void SystemSolver::begin(double m) {
  if (may_choose()) {
    const auto tried = std::find_if(trials_.begin(), trials_.end(), [&](const Trial& t) { return t.m == m; });
    way_ = tried != trials_.end() ? tried->way : Way::factor;
  } else {
    way_ = may_iterate_ ? Way::cg : Way::factor;
  }
  keeps_factor_ = m != 0.0;
  has_factor_ = false;
}

/// Iterations that cost what a minimization by a factor does.
double SystemSolver::cg_budget() const {
  const auto n = static_cast<double>(pins_->free_vertices().size());
  if (n == 0.0) return 0.0;
  const double blocks = 2.0 * pattern_->block_count() * n / pattern_->vertex_count();
  const double nonzeros = expected_nonzeros(n);
  return (kPerFlop * expected_flops(n) + (kPerNonzero + kSolves * kPerNonzeroOfSolve) * nonzeros) /
         (kPerBlock * blocks);
}

FactorStatus SystemSolver::solve(const BlockHessian& H, const VecX& b, double tolerance, double goal,
                                 VecX& x) {
  if (way_ == Way::factor) return solve_by_factor(H, b, tolerance, x);
  if (!cg_.is_analyzed()) cg_.analyze(pattern_, *pins_);
  if (!cg_.set_matrix(H)) return FactorStatus::not_positive_definite;
  CgLimits limits{tolerance, kMostIterations};
  if (may_factorize_) {
    limits.budget = cg_budget();
    limits.max_iterations = static_cast<int>(std::min<double>(2.0 * limits.budget, kMostIterations));
    // Half as many vertices apart are the ends of a body, and it takes as many iterations that they hear of
    // each other.
    limits.probe = static_cast<int>(2.0 * std::cbrt(static_cast<double>(pins_->free_vertices().size()))) + 1;
    limits.goal = goal;
  }
  const CgReport report = cg_.solve(b, limits, x);
  counts_.cg_iterations += report.iterations;
  if (report.status == CgStatus::negative_curvature) return FactorStatus::not_positive_definite;
  if (report.status == CgStatus::converged || !may_factorize_) return FactorStatus::ok;
  way_ = Way::factor;
  const FactorStatus status = solve_by_factor(H, b, tolerance, x);
  if (status != FactorStatus::out_of_memory) return status;
  // What does not fit is left to the iterations, however many.
  way_ = Way::cg;
  may_factorize_ = false;
  return solve(H, b, tolerance, goal, x);
}

FactorStatus SystemSolver::solve_by_factor(const BlockHessian& H, const VecX& b, double tolerance, VecX& x) {
  if (!factor_is_analyzed_) {
    factor_.analyze(pattern_, *pins_);
    factor_is_analyzed_ = true;
  }
  if (has_factor_ && keeps_factor_) {
    FactorCg system(H, *pins_, factor_);
    VecX rhs = b;
    pins_->clear_pinned(rhs);
    const double nonzeros = factor_.factor_nonzeros();
    const double worth = (kPerFlop * factor_.factor_flops() + kPerNonzero * nonzeros) /
                         (kPerNonzeroOfSolve * nonzeros + kPerBlock * pattern_->block_count());
    CgLimits limits{tolerance, std::max(static_cast<int>(0.5 * worth), 1)};
    const CgReport report = conjugate_gradients(system, rhs, limits, x);
    counts_.factor_iterations += report.iterations;
    if (report.status == CgStatus::converged) return FactorStatus::ok;
  }
  has_factor_ = false;
  ++counts_.factorizations;
  const FactorStatus status = factor_.factorize(H);
  if (status != FactorStatus::ok) return status;
  has_factor_ = true;
  factor_.solve(b, x);
  return status;
}

}  // namespace lagomorph::sim
