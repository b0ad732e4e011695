#pragma once

#include <cmath>

#include "sim/kinematics.h"
#include "sim/settings.h"

namespace lagomorph::sim {

/// Fibres along the unit vector a of the rest shape, added to any of the materials:
/// ψ = k1/(2 k2) (exp(k2 (I_4 - 1)²) - 1), I_4 = |F a|², and k1/2 (I_4 - 1)² where k2 = 0. [Holzapfel,
/// Gasser, Ogden 2000, "A New Constitutive Framework for Arterial Wall Mechanics", Eq. 64] As there, slack
/// fibres (I_4 < 1) carry nothing, as they buckle, unless `compression` is set. At rest they are without
/// stress and add 4 k1 to the modulus along a in tension; defined for every F, J <= 0 included.
struct Fibre {
  static constexpr const char* kName = "fibre";
  static constexpr bool kNeedsPositiveJ = false;
  Vec3 a;            // of length 1
  double k1, k2;     // [Pa], > 0; >= 0
  bool compression;  // they push too

  /// From settings that have fibres: k1 = stiffness/4, k2 = exponent.
  static Fibre from_settings(const MaterialSettings&, const std::string& where);

  double psi(const Mat3& F) const {
    const double e = strain(F), x = k2 * e * e;
    return 0.5 * k1 * e * e * (x > 0.0 ? std::expm1(x) / x : 1.0);
  }
  /// P = 2 ψ_4 F a aᵀ.
  Mat3 dpsi_dF(const Mat3& F) const { return 2.0 * psi_4(strain(F)) * (F * a) * a.transpose(); }
  /// 2 ψ_4 1⊗(a aᵀ) + 4 ψ_44 (F a)(F a)ᵀ⊗(a aᵀ).
  Mat9 d2psi_dF2(const Mat3& F) const {
    const Vec3 d = F * a;
    const double e = strain(F);
    return spread(2.0 * psi_4(e) * Mat3::Identity() + 4.0 * psi_44(F) * d * d.transpose());
  }
  /// Eigenvalues 2 ψ_4 twice across F a, 2 ψ_4 + 4 ψ_44 I_4 along it, and six zeros. [Kim, de Goes, Iben
  /// 2019, "Anisotropic Elasticity for Inversion-Safety and Element Rehabilitation"]
  Mat9 projected_d2psi_dF2(const Mat3& F) const {
    const Vec3 d = F * a;
    const double across = 2.0 * psi_4(strain(F));
    if (across >= 0.0) return d2psi_dF2(F);
    const double I_4 = d.squaredNorm(), along = across + 4.0 * psi_44(F) * I_4;
    if (!(along > 0.0)) return Mat9::Zero();
    return spread(along / I_4 * d * d.transpose());
  }
  double stiffness() const { return k1; }

private:
  /// I_4 - 1, or 0 where slack fibres do nothing.
  double strain(const Mat3& F) const {
    const double e = (F * a).squaredNorm() - 1.0;
    return compression || e > 0.0 ? e : 0.0;
  }
  double psi_4(double e) const { return k1 * e * std::exp(k2 * e * e); }
  double psi_44(const Mat3& F) const {
    const double e = strain(F);
    if (!compression && e == 0.0) return 0.0;
    return k1 * (1.0 + 2.0 * k2 * e * e) * std::exp(k2 * e * e);
  }
  /// The 9×9 matrix A⊗(a aᵀ) over row-major vec(F).
  Mat9 spread(const Mat3& A) const {
    const Mat3 aa = a * a.transpose();
    Mat9 H;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) H.block<3, 3>(3 * i, 3 * k) = A(i, k) * aa;
    return H;
  }
};

}  // namespace lagomorph::sim
