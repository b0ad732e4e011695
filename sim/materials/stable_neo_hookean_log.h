#pragma once

#include <cmath>

#include "sim/materials/invariants.h"
#include "sim/settings.h"

namespace lagomorph::sim {

/// ψ = m/2 (I_C - 3) + l/2 (J - a)² - m/2 log(I_C + 1) + const with ψ(I) = 0. Defined for every F.
/// [Smith, de Goes, Kim 2018, "Stable Neo-Hookean Flesh Simulation", Eq. 14, and Section 3.4 for the
/// constants]: m = 4mu/3, l = lambda + 5mu/6, a = 1 + m/l - m/(4l), so that it linearises to (mu, lambda) and
/// rests at F = I.
struct StableNeoHookeanLog {
  static constexpr const char* kName = "stable_neo_hookean_log";
  static constexpr bool kNeedsPositiveJ = false;
  double m, l;  // [Pa]

  static StableNeoHookeanLog from_settings(const MaterialSettings&, const std::string& where);

  /// l (J - a), with l a = l + 3m/4.
  double pressure(double J) const { return l * (J - 1.0) - 0.75 * m; }

  double psi(const Mat3& F) const { return psi(Invariants(F)); }
  double psi(const Invariants& inv) const {
    const double dI = inv.I_C - 3.0, dJ = inv.J - 1.0;
    // l/2 ((J - a)² - (1 - a)²) = (J - 1) (l (J - 1)/2 - 3m/4)
    return 0.5 * m * (dI - std::log1p(0.25 * dI)) + dJ * (0.5 * l * dJ - 0.75 * m);
  }
  Mat3 dpsi_dF(const Mat3& F) const { return stress(derivatives(Invariants(F)), F); }
  Mat9 d2psi_dF2(const Mat3& F) const { return stress_derivative(derivatives(Invariants(F)), F); }
  Mat9 projected_d2psi_dF2(const Mat3& F) const {
    return projected_stress_derivative(derivatives(Invariants(F)), F);
  }
  double stiffness() const { return m + l; }

  InvariantDerivatives derivatives(const Invariants& inv) const {
    const double b = inv.I_C + 1.0;
    return {.I = 0.5 * m * (inv.I_C / b), .J = pressure(inv.J), .II = 0.5 * m / (b * b), .IJ = 0.0, .JJ = l};
  }
};

}  // namespace lagomorph::sim
