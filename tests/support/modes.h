#pragma once

#include <cmath>
#include <stdexcept>
#include <vector>

#include <Eigen/Dense>

#include "sim/linear_solver.h"
#include "sim/model.h"

namespace lagomorph::sim {

struct Mode {
  double omega = 0.0;  // [rad/s]
  VecX shape;          // 3n, zero where pinned, φᵀMφ = 1
};

/// The lowest modes of K φ = ω² M φ, K = ∂²V/∂q² at the rest shape, ascending, by subspace iteration with
/// Rayleigh and Ritz's projection. The model must be pinned, so that K is positive definite.
inline std::vector<Mode> lowest_modes(const Model& model, int count) {
  const VecX X = model.initial_state().q;
  BlockHessian K(model.pattern());
  K.set_zero();
  for (const auto& term : model.energies()) term->add_hessian(X, 1.0, HessianKind::exact, K);
  LinearSolver solver(1);
  solver.analyze(model.pattern(), model.pins());
  if (solver.factorize(K) != FactorStatus::ok) throw std::runtime_error("K is not positive definite");

  const int columns = 2 * count + 4;
  Eigen::MatrixXd phi = Eigen::MatrixXd::Zero(X.size(), columns);
  for (int c = 0; c < columns; ++c) {
    for (Eigen::Index i = 0; i < X.size(); ++i)
      phi(i, c) = std::sin(0.7 + 1.3 * c + (0.11 + 0.37 * c) * static_cast<double>(i));
    VecX v = phi.col(c);
    model.pins().clear_pinned(v);
    phi.col(c) = v;
  }
  std::vector<Mode> modes(static_cast<std::size_t>(count));
  double before = 0.0;
  for (int iteration = 0; iteration < 500; ++iteration) {
    Eigen::MatrixXd next(phi.rows(), columns), M_next(phi.rows(), columns), K_next(phi.rows(), columns);
    for (int c = 0; c < columns; ++c) {
      const VecX Mv = model.mass_times(phi.col(c));
      VecX x;
      solver.solve(Mv, x);
      next.col(c) = x;
      M_next.col(c) = model.mass_times(x);
      K_next.col(c) = K.times(x);
    }
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> small(next.transpose() * K_next,
                                                                          next.transpose() * M_next);
    phi = next * small.eigenvectors();
    const double last = small.eigenvalues()[count - 1];
    if (std::abs(last - before) <= 1e-10 * last) {
      for (int m = 0; m < count; ++m) {
        modes[static_cast<std::size_t>(m)].omega = std::sqrt(small.eigenvalues()[m]);
        modes[static_cast<std::size_t>(m)].shape = phi.col(m);
      }
      return modes;
    }
    before = last;
  }
  throw std::runtime_error("subspace iteration did not converge");
}

}  // namespace lagomorph::sim
