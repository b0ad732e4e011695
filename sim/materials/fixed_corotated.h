#pragma once

#include <cmath>

#include "sim/determinant.h"
#include "sim/materials/stretches.h"
#include "sim/settings.h"

namespace lagomorph::sim {

/// ψ = mu |F - R|² + lambda/2 (J - 1)², R the rotation nearest to F, with det R = +1 also where F is
/// inverted. [Stomakhin, Howes, Schroeder, Teran 2012, "Energetically Consistent Invertible Elasticity", Eq.
/// 5-6] Defined for every F, with a crease where σ_i + σ_j = 0. lambda >= 0, as nothing else bounds (J - 1)²
/// from below.
struct FixedCorotated {
  static constexpr const char* kName = "fixed_corotated";
  static constexpr bool kNeedsPositiveJ = false;
  double mu, lambda;  // [Pa], > 0 and >= 0

  static FixedCorotated from_settings(const MaterialSettings&, const std::string& where);

  double psi(const Mat3& F) const {
    const double dJ = determinant(F) - 1.0;
    return mu * (RotationSvd(F).sigma.array() - 1.0).matrix().squaredNorm() + 0.5 * lambda * dJ * dJ;
  }
  /// P = 2 mu (F - R) + lambda (J - 1) cof F.
  Mat3 dpsi_dF(const Mat3& F) const {
    return 2.0 * mu * (F - RotationSvd(F).R()) + pressure(F) * cofactor(F);
  }
  Mat9 d2psi_dF2(const Mat3& F) const { return second_derivative(F, RotationSvd(F)); }
  Mat9 projected_d2psi_dF2(const Mat3& F) const {
    const RotationSvd svd(F);
    const Vec3 &s = svd.sigma, g = svd.cofactors();
    const double p = pressure(F);
    StretchEigensystem eigen;
    eigen.twist = 2.0 * mu - 4.0 * mu * pair_sums(svd).array().inverse() + p * s.array();
    eigen.flip = 2.0 * mu - p * s.array();
    eigen.scaling = lambda * g * g.transpose() + 2.0 * mu * Mat3::Identity();
    for (int k = 0; k < 3; ++k) {
      eigen.scaling((k + 1) % 3, (k + 2) % 3) += p * s[k];
      eigen.scaling((k + 2) % 3, (k + 1) % 3) += p * s[k];
    }
    return without_negative_eigenvalues(second_derivative(F, svd), svd, eigen);
  }
  double stiffness() const { return mu + lambda; }

private:
  double pressure(const Mat3& F) const { return lambda * (determinant(F) - 1.0); }
  /// 2 mu (1 - ∂R/∂F) + lambda g gᵀ + lambda (J - 1) ∂²J/∂F², with g = vec(cof F).
  Mat9 second_derivative(const Mat3& F, const RotationSvd& svd) const {
    const Vec9 g = vec(cofactor(F));
    const double p = pressure(F);
    Mat9 H = lambda * g * g.transpose() - 2.0 * mu * rotation_derivative(svd);
    H.diagonal().array() += 2.0 * mu;
    for_each_second_derivative_of_J(F, [&](int row, int column, double x) { H(row, column) += p * x; });
    return H;
  }
};

}  // namespace lagomorph::sim
