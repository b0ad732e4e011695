#pragma once

#include <memory>
#include <string>

#include "sim/block_hessian.h"
#include "sim/pins.h"

namespace lagomorph::sim {

enum class FactorStatus { ok, not_positive_definite, out_of_memory };

/// Solves P H Pᵀ x_free = P b by a sparse factorization; the pinned rows and columns are left out exactly.
/// The order of elimination and the structure of the factor are found once a topology, by analyze().
class LinearSolver {
public:
  /// `blas_threads` is part of the result's bits: a constant of the scene, never of the machine.
  explicit LinearSolver(int blas_threads);
  ~LinearSolver();
  LinearSolver(LinearSolver&&) noexcept;
  LinearSolver& operator=(LinearSolver&&) noexcept;

  /// Throws std::bad_alloc.
  void analyze(std::shared_ptr<const BlockPattern>, const Pins&);
  /// H = LLᵀ, supernodal. H must be on the analyzed pattern.
  FactorStatus factorize(const BlockHessian& H);
  /// H = LDLᵀ without pivoting, for an H that may be indefinite: not_positive_definite only at a zero pivot.
  /// Its solutions are to be checked, and refined, by the caller.
  FactorStatus factorize_indefinite(const BlockHessian& H);
  /// x = Pᵀ (P H Pᵀ)⁻¹ P b, 3n: zero where pinned. After a factorization that was ok.
  void solve(const VecX& b, VecX& x);

  /// Size of the factor of the analyzed pattern: nonzeros of L, and floating-point operations to make it.
  double factor_nonzeros() const;
  double factor_flops() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// What the linear algebra underneath is, for run.json.
struct LinearAlgebraInfo {
  std::string cholmod;            // version
  std::string blas;               // OpenBLAS's configuration, version first
  std::string blas_kernel;        // core type that OpenBLAS has chosen for this CPU
  int blas_threads = 1;           // that it uses now
  std::string blas_library;       // file that CHOLMOD's dpotrf resolves to
  bool blas_is_openblas = false;  // whether that file is OpenBLAS's
};
LinearAlgebraInfo linear_algebra_info();
/// Its blas_kernel alone, which costs nothing.
std::string blas_kernel();

}  // namespace lagomorph::sim
