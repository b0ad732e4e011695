#include "sim/system_solver.h"

#include <algorithm>
#include <cmath>

namespace lagomorph::sim {

namespace {

// Weights of the work, in nanoseconds on the machine that they were taken on (AMD EPYC, OpenBLAS's AVX-512
// kernel): only their ratios matter.
constexpr double kPerBlock = 1.7;           // of a product and the vectors of an iteration
constexpr double kPerFlop = 0.03;           // of a factorization
constexpr double kPerNonzero = 10.0;        // of a factorization, besides its operations
constexpr double kPerNonzeroOfSolve = 1.6;  // of forward and backward substitution

/// Of a bunny's factor in n free vertices by nested dissection, within a factor of two from 1,000 to 40,000.
double expected_flops(double n) { return 50.0 * n * n; }
double expected_nonzeros(double n) { return 30.0 * std::pow(n, 4.0 / 3.0); }

constexpr int kProbe = 32;                   // iterations after which CG asks itself whether it pays
constexpr double kFewestIterations = 100.0;  // that a factorization must cost for CG to be tried at all
constexpr int kMostIterations = 20000;

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
  begin(false);
}

void SystemSolver::begin(bool may_be_singular) {
  const bool pays = cg_budget() >= kFewestIterations && !may_be_singular;
  way_ = may_iterate_ && (pays || !may_factorize_) ? Way::cg : Way::factor;
  keeps_factor_ = !may_be_singular;
  has_factor_ = false;
}

/// Iterations that cost what a factorization does.
double SystemSolver::cg_budget() const {
  const auto n = static_cast<double>(pins_->free_vertices().size());
  if (n == 0.0) return 0.0;
  const double blocks = 2.0 * pattern_->block_count() * n / pattern_->vertex_count();
  return (kPerFlop * expected_flops(n) + kPerNonzero * expected_nonzeros(n)) / (kPerBlock * blocks);
}

FactorStatus SystemSolver::solve(const BlockHessian& H, const VecX& b, double tolerance, double goal,
                                 VecX& x) {
  if (way_ == Way::factor) return solve_by_factor(H, b, tolerance, x);
  if (!cg_.is_analyzed()) cg_.analyze(pattern_, *pins_);
  if (!cg_.set_matrix(H)) return FactorStatus::not_positive_definite;
  CgLimits limits{tolerance, kMostIterations};
  if (may_factorize_) {
    limits.max_iterations = static_cast<int>(std::min<double>(cg_budget(), kMostIterations));
    limits.probe = kProbe;
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
