#pragma once

#include <memory>

#include "sim/block_hessian.h"
#include "sim/conjugate_gradient.h"
#include "sim/linear_solver.h"
#include "sim/pins.h"
#include "sim/settings.h"
#include "sim/solve_counts.h"

namespace lagomorph::sim {

/// Solves the systems of one minimization after the other, each to the tolerance asked for, by solver.linear:
///
/// - "cg": conjugate gradients preconditioned by the diagonal's 3×3 blocks.
/// - "cholmod": a Cholesky factorization of a minimization's first matrix; of those after it only when
///   conjugate gradients preconditioned by that factor would cost more.
/// - "auto": conjugate gradients while what they still ask for, by counted blocks, is less work than a
///   factorization, by an estimate of its nonzeros and operations; then the factor. No clock is asked: the
///   way is a function of the matrices, and so the same on a busy machine.
///
/// Nothing is carried from one minimization to the next, so that a run that is taken up again goes the same
/// way.
class SystemSolver {
public:
  explicit SystemSolver(const SolverSettings&);
  /// Of a topology and its pins; what is made from them is made when it is first needed.
  void analyze(std::shared_ptr<const BlockPattern>, const Pins&);
  /// Begins a minimization. Where its matrices may be singular, each is factorized, unless solver.linear =
  /// "cg".
  void begin(bool may_be_singular);
  /// x = Pᵀ (P H Pᵀ)⁻¹ P b, 3n, so that |P (b - H x)| is about `tolerance` |P b| or less. `goal` <= tolerance
  /// is what the minimization as a whole still asks for. x goes downhill of ½ xᵀHx - bᵀx.
  FactorStatus solve(const BlockHessian& H, const VecX& b, double tolerance, double goal, VecX& x);

  /// How often each way was gone, in all.
  const SolveCounts& counts() const { return counts_; }

private:
  enum class Way { cg, factor };
  FactorStatus solve_by_factor(const BlockHessian& H, const VecX& b, double tolerance, VecX& x);
  double cg_budget() const;

  bool may_factorize_, may_iterate_;
  LinearSolver factor_;
  BlockJacobiCg cg_;
  std::shared_ptr<const BlockPattern> pattern_;
  const Pins* pins_ = nullptr;
  bool factor_is_analyzed_ = false;
  // Of this minimization:
  Way way_ = Way::cg;
  bool has_factor_ = false, keeps_factor_ = true;
  SolveCounts counts_;
};

}  // namespace lagomorph::sim
