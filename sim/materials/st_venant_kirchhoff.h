#pragma once

#include <cmath>

#include "sim/materials/stretches.h"
#include "sim/settings.h"

namespace lagomorph::sim {

/// ψ = mu E:E + lambda/2 (tr E)², E = (FᵀF - I)/2: linear elasticity in Green and Lagrange's strain. Defined
/// for every F, but it resists compression ever less: soft below a stretch of about 0.58, and flat at F = 0.
struct StVenantKirchhoff {
  static constexpr const char* kName = "st_venant_kirchhoff";
  static constexpr bool kNeedsPositiveJ = false;
  double mu, lambda;  // [Pa]

  static StVenantKirchhoff from_settings(const MaterialSettings&, const std::string& where);

  double psi(const Mat3& F) const {
    const Mat3 E = green_lagrange(F);
    return mu * E.squaredNorm() + 0.5 * lambda * E.trace() * E.trace();
  }
  /// P = F S.
  Mat3 dpsi_dF(const Mat3& F) const { return F * second_piola_kirchhoff(F); }
  /// dP = dF S + mu (F dFᵀ F + F Fᵀ dF) + lambda (F : dF) F.
  Mat9 d2psi_dF2(const Mat3& F) const {
    const Mat3 S = second_piola_kirchhoff(F), b = mu * F * F.transpose();
    const Vec9 f = vec(F);
    Mat9 H = lambda * f * f.transpose();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) {
          H(3 * i + j, 3 * i + k) += S(j, k);
          H(3 * i + j, 3 * k + j) += b(i, k);
          for (int l = 0; l < 3; ++l) H(3 * i + j, 3 * k + l) += mu * F(i, l) * F(k, j);
        }
    return H;
  }
  Mat9 projected_d2psi_dF2(const Mat3& F) const {
    const RotationSvd svd(F);
    const Vec3& s = svd.sigma;
    const double pressure = lambda * 0.5 * (s.squaredNorm() - 3.0);  // lambda tr E
    StretchEigensystem eigen;
    eigen.scaling = lambda * s * s.transpose();
    for (int k = 0; k < 3; ++k) {
      const double a = s[(k + 1) % 3], b = s[(k + 2) % 3];
      eigen.twist[k] = mu * (a * a - a * b + b * b - 1.0) + pressure;
      eigen.flip[k] = mu * (a * a + a * b + b * b - 1.0) + pressure;
      eigen.scaling(k, k) += mu * (3.0 * s[k] * s[k] - 1.0) + pressure;
    }
    return without_negative_eigenvalues(d2psi_dF2(F), svd, eigen);
  }
  double stiffness() const { return mu + std::abs(lambda); }

  /// S = 2 mu E + lambda tr(E) I.
  Mat3 second_piola_kirchhoff(const Mat3& F) const {
    const Mat3 E = green_lagrange(F);
    return 2.0 * mu * E + lambda * E.trace() * Mat3::Identity();
  }
};

}  // namespace lagomorph::sim
