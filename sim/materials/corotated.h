#pragma once

#include <cmath>

#include "sim/materials/stretches.h"
#include "sim/settings.h"

namespace lagomorph::sim {

/// ψ = mu |F - R|² + lambda/2 tr(RᵀF - I)², R the rotation nearest to F, with det R = +1 also where F is
/// inverted: linear elasticity turned with the material, in the stretches mu Σ(σ_i - 1)² + lambda/2 (Σσ_i -
/// 3)². [Müller, Gross 2004, "Interactive Virtual Materials"] Defined for every F, with a crease where σ_i +
/// σ_j = 0.
struct Corotated {
  static constexpr const char* kName = "corotated";
  static constexpr bool kNeedsPositiveJ = false;
  double mu, lambda;  // [Pa]

  static Corotated from_settings(const MaterialSettings&, const std::string& where);

  double psi(const Mat3& F) const {
    const Vec3 strain = RotationSvd(F).sigma.array() - 1.0;
    return mu * strain.squaredNorm() + 0.5 * lambda * strain.sum() * strain.sum();
  }
  /// P = 2 mu (F - R) + lambda tr(RᵀF - I) R.
  Mat3 dpsi_dF(const Mat3& F) const {
    const RotationSvd svd(F);
    const Mat3 R = svd.R();
    return 2.0 * mu * (F - R) + pressure(svd) * R;
  }
  Mat9 d2psi_dF2(const Mat3& F) const { return second_derivative(RotationSvd(F)); }
  Mat9 projected_d2psi_dF2(const Mat3& F) const {
    const RotationSvd svd(F);
    StretchEigensystem eigen;
    eigen.twist = 2.0 * mu + 2.0 * (pressure(svd) - 2.0 * mu) * pair_sums(svd).array().inverse();
    eigen.flip = Vec3::Constant(2.0 * mu);
    eigen.scaling = lambda * Mat3::Ones() + 2.0 * mu * Mat3::Identity();
    return without_negative_eigenvalues(second_derivative(svd), svd, eigen);
  }
  double stiffness() const { return mu + std::abs(lambda); }

private:
  double pressure(const RotationSvd& svd) const { return lambda * (svd.sigma.array() - 1.0).sum(); }
  /// 2 mu 1 + lambda r rᵀ + (lambda tr(RᵀF - I) - 2 mu) ∂R/∂F, with r = vec(R).
  Mat9 second_derivative(const RotationSvd& svd) const {
    const Vec9 r = vec(svd.R());
    Mat9 H = lambda * r * r.transpose() + (pressure(svd) - 2.0 * mu) * rotation_derivative(svd);
    H.diagonal().array() += 2.0 * mu;
    return H;
  }
};

}  // namespace lagomorph::sim
