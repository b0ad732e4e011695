#pragma once

#include "sim/materials/stretches.h"
#include "sim/settings.h"

namespace lagomorph::sim {

/// As rigid as possible: ψ = mu |F - R|² = mu Σ(σ_i - 1)², R the rotation nearest to F, with det R = +1 also
/// where F is inverted. [Sorkine, Alexa 2007, "As-Rigid-As-Possible Surface Modeling"; Smith, de Goes, Kim
/// 2019, Section 5.1, with mu for mu/2] Nothing in it resists a change of volume on its own: lambda has no
/// effect, Poisson's ratio is 0 and Young's modulus 2 mu. Defined for every F, with a crease where σ_i + σ_j
/// = 0.
struct Arap {
  static constexpr const char* kName = "arap";
  static constexpr bool kNeedsPositiveJ = false;
  double mu;  // [Pa]

  static Arap from_settings(const MaterialSettings&, const std::string& where);

  double psi(const Mat3& F) const { return mu * (RotationSvd(F).sigma.array() - 1.0).matrix().squaredNorm(); }
  Mat3 dpsi_dF(const Mat3& F) const { return 2.0 * mu * (F - RotationSvd(F).R()); }
  Mat9 d2psi_dF2(const Mat3& F) const { return second_derivative(RotationSvd(F)); }
  Mat9 projected_d2psi_dF2(const Mat3& F) const {
    const RotationSvd svd(F);
    StretchEigensystem eigen;
    eigen.twist = 2.0 * mu - 4.0 * mu * pair_sums(svd).array().inverse();
    eigen.flip = Vec3::Constant(2.0 * mu);
    eigen.scaling = 2.0 * mu * Mat3::Identity();
    return without_negative_eigenvalues(second_derivative(svd), svd, eigen);
  }
  double stiffness() const { return mu; }

private:
  /// 2 mu (1 - ∂R/∂F).
  Mat9 second_derivative(const RotationSvd& svd) const {
    Mat9 H = -2.0 * mu * rotation_derivative(svd);
    H.diagonal().array() += 2.0 * mu;
    return H;
  }
};

}  // namespace lagomorph::sim
