#pragma once

#include "sim/materials/invariants.h"
#include "sim/settings.h"

namespace lagomorph::sim {

/// ψ = mu/2 (I_C - 3) - mu (J - 1) + (lambda + mu)/2 (J - 1)². Defined for every F, also inverted ones.
/// [Smith, de Goes, Kim 2018, "Stable Neo-Hookean Flesh Simulation", Eq. 9-10] without the logarithmic
/// barrier: their mu/2 (I_C - 3) + lambda'/2 (J - alpha)² with alpha = 1 + mu/lambda' and, so that it
/// linearises to (mu, lambda), lambda' = lambda + mu; less a constant, so that ψ(I) = 0.
struct StableNeoHookean {
  static constexpr const char* kName = "stable_neo_hookean";
  static constexpr bool kNeedsPositiveJ = false;
  double mu, lambda;  // [Pa]

  static StableNeoHookean from_settings(const MaterialSettings&, const std::string& where);

  double psi(const Mat3& F) const { return psi(Invariants(F)); }
  double psi(const Invariants& inv) const {
    const double dJ = inv.J - 1.0;
    return 0.5 * mu * (inv.I_C - 3.0) - mu * dJ + 0.5 * (lambda + mu) * dJ * dJ;
  }
  Mat3 dpsi_dF(const Mat3& F) const { return stress(derivatives(Invariants(F)), F); }
  Mat9 d2psi_dF2(const Mat3& F) const { return stress_derivative(derivatives(Invariants(F)), F); }
  Mat9 projected_d2psi_dF2(const Mat3& F) const {
    return projected_stress_derivative(derivatives(Invariants(F)), F);
  }
  double stiffness() const { return mu + std::abs(lambda); }

  InvariantDerivatives derivatives(const Invariants& inv) const {
    return {.I = 0.5 * mu, .J = (lambda + mu) * (inv.J - 1.0) - mu, .II = 0.0, .IJ = 0.0, .JJ = lambda + mu};
  }
};

}  // namespace lagomorph::sim
