#pragma once

#include <cmath>
#include <limits>

#include "sim/materials/invariants.h"
#include "sim/settings.h"

namespace lagomorph::sim {

/// ψ = C (J^(-2/3) I_C - 3) + D (J - 1)², C = mu/2, D = lambda/2. (lecture, "Neo-Hookean")
/// Not defined for J <= 0, where it is +inf. Its shear modulus is mu, its bulk modulus lambda (not lambda +
/// 2mu/3).
struct NeoHookean {
  static constexpr const char* kName = "neo_hookean";
  static constexpr bool kNeedsPositiveJ = true;
  double C, D;  // [Pa], > 0 and >= 0

  static NeoHookean from_settings(const MaterialSettings&, const std::string& where);

  double psi(const Mat3& F) const { return psi(Invariants(F)); }
  double psi(const Invariants& inv) const {
    if (!(inv.J > 0.0)) return std::numeric_limits<double>::infinity();
    const double cbrt = std::cbrt(inv.J);
    return C * (inv.I_C / (cbrt * cbrt) - 3.0) + D * (inv.J - 1.0) * (inv.J - 1.0);
  }
  Mat3 dpsi_dF(const Mat3& F) const { return stress(derivatives(Invariants(F)), F); }
  Mat9 d2psi_dF2(const Mat3& F) const { return stress_derivative(derivatives(Invariants(F)), F); }
  Mat9 projected_d2psi_dF2(const Mat3& F) const {
    return projected_stress_derivative(derivatives(Invariants(F)), F);
  }
  double stiffness() const { return 2.0 * (C + D); }

  InvariantDerivatives derivatives(const Invariants& inv) const {
    const double cbrt = std::cbrt(inv.J);
    const double a = C / (cbrt * cbrt);  // C J^(-2/3)
    return {.I = a,
            .J = -2.0 / 3.0 * a * inv.I_C / inv.J + 2.0 * D * (inv.J - 1.0),
            .II = 0.0,
            .IJ = -2.0 / 3.0 * a / inv.J,
            .JJ = 10.0 / 9.0 * a * inv.I_C / (inv.J * inv.J) + 2.0 * D};
  }
};

}  // namespace lagomorph::sim
