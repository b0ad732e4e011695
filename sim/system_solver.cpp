#include "sim/system_solver.h"

#include <algorithm>
#include <cmath>

#include "sim/parallel.h"

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

constexpr double kSolves = 5.0;                // with a factor that a minimization takes until its end
constexpr double kFewestIterations = 100.0;    // that a factorization must cost for CG to be tried at all
constexpr double kMostNonzerosAtRest = 1.5e8;  // of a factor that is kept besides the one in use
constexpr double kMostStrainAtRest = 0.02;     // above which that factor is not worth a try
constexpr int kVerticesOfPiece = 2048;
constexpr int kMostIterations = 20000;
constexpr double kTrialTolerance = 1e-3, kTrials = 2.2;  // of these a minimization to 3e-7 is made

/// H preconditioned by a factor of another matrix, turned by a rotation at each vertex.
class FactorCg : public CgSystem {
public:
  FactorCg(const BlockHessian& H, const Pins& pins, LinearSolver& factor, const std::vector<Mat3>& rotations)
      : H_(H), pins_(pins), factor_(factor), rotations_(rotations) {}
  double times(const VecX& p, VecX& y) override {
    y = H_.times(p);
    pins_.clear_pinned(y);
    return p.dot(y);
  }
  Products update(double alpha, const VecX& p, const VecX& y, VecX& x, VecX& r, VecX& z) override {
    x += alpha * p;
    r -= alpha * y;
    if (rotations_.empty()) {
      factor_.solve(r, z);
    } else {
      turned_.resize(r.size());
      for_vertices(
          [&](int i, const Mat3& R) { turned_.segment<3>(i).noalias() = R.transpose() * r.segment<3>(i); });
      factor_.solve(turned_, z);
      for_vertices([&](int i, const Mat3& R) { z.segment<3>(i) = R * Vec3(z.segment<3>(i)); });
    }
    return {r.squaredNorm(), r.dot(z)};
  }

private:
  const BlockHessian& H_;
  const Pins& pins_;
  template <class Turn>
  void for_vertices(const Turn& turn) const {
    parallel_for(static_cast<int>(rotations_.size()), kVerticesOfPiece, [&](int begin, int end) {
      for (int v = begin; v < end; ++v) turn(3 * v, rotations_[static_cast<std::size_t>(v)]);
    });
  }

  LinearSolver& factor_;
  const std::vector<Mat3>& rotations_;
  VecX turned_;
};

}  // namespace

SystemSolver::SystemSolver(const SolverSettings& settings)
    : may_factorize_(settings.linear != "cg"),
      may_iterate_(settings.linear != "cholmod"),
      blas_threads_(settings.blas_threads),
      factor_(settings.blas_threads) {}

void SystemSolver::analyze(std::shared_ptr<const BlockPattern> pattern, const Pins& pins) {
  pattern_ = std::move(pattern);
  pins_ = &pins;
  cg_ = BlockJacobiCg();
  factor_is_analyzed_ = false;
  trials_.clear();
  factor_at_rest_.reset();
  m_at_rest_ = 0.0;
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
  if (way == Way::factor) factorize_at_rest(m, H);
}

void SystemSolver::factorize_at_rest(double m, const BlockHessian& H) {
  if (!factor_at_rest_) {
    factor_at_rest_.emplace(blas_threads_);
    factor_at_rest_->analyze(pattern_, *pins_);
  }
  m_at_rest_ = 0.0;
  if (factor_at_rest_->factor_nonzeros() > kMostNonzerosAtRest) return;
  if (factor_at_rest_->factorize(H) == FactorStatus::ok) m_at_rest_ = m;
}

void SystemSolver::begin(double m, const std::function<VertexRotations()>& rotations) {
  if (may_choose()) {
    const auto tried = std::find_if(trials_.begin(), trials_.end(), [&](const Trial& t) { return t.m == m; });
    way_ = tried != trials_.end() ? tried->way : Way::factor;
  } else {
    way_ = may_iterate_ ? Way::cg : Way::factor;
  }
  keeps_factor_ = m != 0.0;
  has_factor_ = false;
  rests_ = way_ == Way::factor && m != 0.0 && m == m_at_rest_ && rotations;
  rotations_.clear();
  if (!rests_) return;
  VertexRotations turned = rotations();
  rests_ = turned.strain <= kMostStrainAtRest;
  rotations_ = std::move(turned.R);
  for (const int v : pins_->vertices()) rotations_[static_cast<std::size_t>(v)] = Mat3::Identity();
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

bool SystemSolver::solve_by_old_factor(LinearSolver& factor, const std::vector<Mat3>& rotations,
                                       const BlockHessian& H, const VecX& b, double tolerance, VecX& x) {
  FactorCg system(H, *pins_, factor, rotations);
  VecX rhs = b;
  pins_->clear_pinned(rhs);
  const double nonzeros = factor.factor_nonzeros();
  const double worth = (kPerFlop * factor.factor_flops() + kPerNonzero * nonzeros) /
                       (kPerNonzeroOfSolve * nonzeros + kPerBlock * pattern_->block_count());
  CgLimits limits{tolerance, std::max(static_cast<int>(0.5 * worth), 1)};
  limits.probe = 2;
  limits.goal = tolerance;
  limits.budget = 0.5 * worth;
  const CgReport report = conjugate_gradients(system, rhs, limits, x);
  counts_.factor_iterations += report.iterations;
  return report.status == CgStatus::converged;
}

FactorStatus SystemSolver::solve_by_factor(const BlockHessian& H, const VecX& b, double tolerance, VecX& x) {
  if (!factor_is_analyzed_) {
    factor_.analyze(pattern_, *pins_);
    factor_is_analyzed_ = true;
  }
  if (has_factor_ && keeps_factor_ && solve_by_old_factor(factor_, {}, H, b, tolerance, x))
    return FactorStatus::ok;
  if (rests_ && !has_factor_) {
    if (solve_by_old_factor(*factor_at_rest_, rotations_, H, b, tolerance, x)) return FactorStatus::ok;
    rests_ = false;
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
