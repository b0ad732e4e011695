#pragma once

#include "sim/determinant.h"
#include "sim/kinematics.h"

/// Densities that depend on F through I_C = tr(FᵀF) and J = det F alone: their stress and Hessian follow from
/// the partial derivatives of ψ(I_C, J) by the chain rule, with ∂I_C/∂F = 2F, ∂J/∂F = cof F.
namespace lagomorph::sim {

struct Invariants {
  double I_C, J;
  explicit Invariants(const Mat3& F) : I_C(F.squaredNorm()), J(determinant(F)) {}
  Invariants(double of_C, double of_F) : I_C(of_C), J(of_F) {}
};

/// ∂ψ/∂I_C, ∂ψ/∂J and the second derivatives. [Pa]
struct InvariantDerivatives {
  double I = 0.0, J = 0.0, II = 0.0, IJ = 0.0, JJ = 0.0;
};

/// ∂ψ/∂F = 2 ψ_I F + ψ_J cof F.
inline Mat3 stress(const InvariantDerivatives& d, const Mat3& F) { return 2.0 * d.I * F + d.J * cofactor(F); }

/// ∂²ψ/∂F² = 2 ψ_I 1 + 4 ψ_II f fᵀ + 2 ψ_IJ (f gᵀ + g fᵀ) + ψ_JJ g gᵀ + ψ_J ∂²J/∂F², with f = vec(F), g =
/// vec(cof F).
inline Mat9 stress_derivative(const InvariantDerivatives& d, const Mat3& F) {
  const Vec9 f = vec(F), g = vec(cofactor(F));
  // g (ψ_JJ g + 2 ψ_IJ f)ᵀ + f (2 ψ_IJ g + 4 ψ_II f)ᵀ
  const Vec9 by_g = d.JJ * g + 2.0 * d.IJ * f, by_f = 2.0 * d.IJ * g + 4.0 * d.II * f;
  Mat9 H = g * by_g.transpose() + f * by_f.transpose();
  H.diagonal().array() += 2.0 * d.I;
  for_each_second_derivative_of_J(F,
                                  [&](int row, int column, double value) { H(row, column) += d.J * value; });
  return H;
}

/// The same with its negative eigenvalues set to zero.
Mat9 projected_stress_derivative(const InvariantDerivatives& d, const Mat3& F);

}  // namespace lagomorph::sim
