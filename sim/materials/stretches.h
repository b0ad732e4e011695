#pragma once

#include "sim/kinematics.h"

/// Isotropic densities as functions of the stretches: what they share whatever their formula.
namespace lagomorph::sim {

/// F = U diag(sigma) Vᵀ with rotations U and V: the last of the descending singular values takes the sign of
/// det F, and its size is the smallest. NaN where F is not finite.
struct RotationSvd {
  Mat3 U, V;
  Vec3 sigma;
  explicit RotationSvd(const Mat3& F);
  /// The rotation nearest to F, with det R = +1 also where F is inverted.
  Mat3 R() const { return U * V.transpose(); }
  /// Cofactors of diag(sigma): ∂J/∂σ.
  Vec3 cofactors() const { return {sigma[1] * sigma[2], sigma[2] * sigma[0], sigma[0] * sigma[1]}; }
};

/// Eigensystem of ∂²ψ/∂F² of an isotropic ψ(σ) [Pa]: three twists U T_k Vᵀ, three flips U L_k Vᵀ, with T_k,
/// L_k the antisymmetric and symmetric unit matrices of the pair (i, j) = (k+1, k+2), and the eigenvectors of
/// a 3×3 block in the span of the stretches. [Smith, de Goes, Kim 2019, "Analytic Eigensystems for Isotropic
/// Distortion Energies", Section 5]
struct StretchEigensystem {
  Vec3 twist;    // (ψ_i + ψ_j)/(σ_i + σ_j), each divided out in closed form
  Vec3 flip;     // (ψ_i - ψ_j)/(σ_i - σ_j), likewise
  Mat3 scaling;  // ∂²ψ/∂σ_i∂σ_j
};

/// H = ∂²ψ/∂F² at F = U diag(σ) Vᵀ with its negative eigenvalues set to zero: what is negative is taken out
/// of H, which is otherwise left as it is.
Mat9 without_negative_eigenvalues(Mat9 H, const RotationSvd&, const StretchEigensystem&);

/// ∂R/∂F = Σ_k 2/(σ_i + σ_j) t_k t_kᵀ with the twists t_k. R jumps where σ_i + σ_j = 0; the sum is held above
/// kLeastPairSum there, so that the derivative stays finite.
Mat9 rotation_derivative(const RotationSvd&);

inline constexpr double kLeastPairSum = 1e-12;
/// σ_i + σ_j of each pair, held above kLeastPairSum.
Vec3 pair_sums(const RotationSvd&);

}  // namespace lagomorph::sim
