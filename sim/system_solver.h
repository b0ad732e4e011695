#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "sim/block_hessian.h"
#include "sim/conjugate_gradient.h"
#include "sim/linear_solver.h"
#include "sim/pins.h"
#include "sim/settings.h"
#include "sim/solve_counts.h"
#include "sim/vertex_rotations.h"

namespace lagomorph::sim {

/// Solves the systems of one minimization after the other, each to the tolerance asked for, by solver.linear:
///
/// - "cg": conjugate gradients preconditioned by the diagonal's 3×3 blocks.
/// - "cholmod": a Cholesky factorization of a minimization's first matrix; of those after it only when
///   conjugate gradients preconditioned by that factor would cost more.
/// - "auto": the one of these that a trial on the bodies at rest finds to be less work, by counted iterations
///   and blocks and by an estimate of the factor's nonzeros and operations; conjugate gradients only while
///   what they still ask for does not belie it. Where it is a factorization, one of the matrix at rest
///   preconditions conjugate gradients as long as these cost less than a factorization. No clock is asked:
///   the way is a function of the matrices, and so the same on a busy machine.
///
/// Nothing is carried from one minimization to the next but that trial's outcome and that factor, which are
/// functions of the model alone, so that a run that is taken up again goes the same way.
class SystemSolver {
public:
  explicit SystemSolver(const SolverSettings&);
  /// Of a topology and its pins; what is made from them is made when it is first needed.
  void analyze(std::shared_ptr<const BlockPattern>, const Pins&);
  /// Whether try_at_rest() is to be called before a minimization with m/2 qᵀM q in it begins. m > 0.
  bool needs_trial(double m) const;
  /// `H` and `b` as they are at rest: decides how minimizations with this m begin.
  void try_at_rest(double m, const BlockHessian& H, const VecX& b);
  /// Begins a minimization. Where m is 0 its matrices may be singular and each is factorized, unless
  /// solver.linear = "cg".
  /// `rotations` are asked for when they serve, see vertex_rotations(): H is about R H₀ Rᵀ, with H₀ that at
  /// rest.
  void begin(double m, const std::function<VertexRotations()>& rotations = {});
  /// x = Pᵀ (P H Pᵀ)⁻¹ P b, 3n, so that |P (b - H x)| is about `tolerance` |P b| or less. `goal` <= tolerance
  /// is what the minimization as a whole still asks for. x goes downhill of ½ xᵀHx - bᵀx.
  FactorStatus solve(const BlockHessian& H, const VecX& b, double tolerance, double goal, VecX& x);

  /// How often each way was gone, in all.
  const SolveCounts& counts() const { return counts_; }

private:
  enum class Way { cg, factor };
  FactorStatus solve_by_factor(const BlockHessian& H, const VecX& b, double tolerance, VecX& x);
  /// By a factor of another matrix, while that is less work than a factorization.
  bool solve_by_old_factor(LinearSolver& factor, const std::vector<Mat3>& rotations, const BlockHessian& H,
                           const VecX& b, double tolerance, VecX& x);
  void factorize_at_rest(double m, const BlockHessian& H);
  double cg_budget() const;
  bool may_choose() const { return may_factorize_ && may_iterate_; }

  bool may_factorize_, may_iterate_;
  int blas_threads_;
  LinearSolver factor_;
  std::optional<LinearSolver> factor_at_rest_;  // of minimizations with
  double m_at_rest_ = 0.0;                      // this m
  BlockJacobiCg cg_;
  std::shared_ptr<const BlockPattern> pattern_;
  const Pins* pins_ = nullptr;
  bool factor_is_analyzed_ = false;
  struct Trial {
    double m;
    Way way;
  };
  std::vector<Trial> trials_;  // for these pins
  // Of this minimization:
  Way way_ = Way::cg;
  std::vector<Mat3> rotations_;  // from rest; none: it is as at rest
  bool has_factor_ = false, keeps_factor_ = true, rests_ = false;
  SolveCounts counts_;
};

}  // namespace lagomorph::sim
