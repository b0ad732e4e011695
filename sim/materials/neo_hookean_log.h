#pragma once

#include <cmath>
#include <limits>

#include "sim/materials/invariants.h"
#include "sim/settings.h"

namespace lagomorph::sim {

/// ψ = mu/2 (I_C - 3) - mu ln J + lambda/2 (ln J)². [Bonet, Wood 1997, "Nonlinear Continuum Mechanics for
/// Finite Element Analysis", Section 5.4.3] Not defined for J <= 0, where it is +inf.
struct NeoHookeanLog {
  static constexpr const char* kName = "neo_hookean_log";
  static constexpr bool kNeedsPositiveJ = true;
  double mu, lambda;  // [Pa], > 0 and >= 0

  static NeoHookeanLog from_settings(const MaterialSettings&, const std::string& where);

  double psi(const Mat3& F) const { return psi(Invariants(F)); }
  double psi(const Invariants& inv) const {
    if (!(inv.J > 0.0)) return std::numeric_limits<double>::infinity();
    const double log_J = std::log(inv.J);
    return 0.5 * mu * (inv.I_C - 3.0) + log_J * (0.5 * lambda * log_J - mu);
  }
  Mat3 dpsi_dF(const Mat3& F) const { return stress(derivatives(Invariants(F)), F); }
  Mat9 d2psi_dF2(const Mat3& F) const { return stress_derivative(derivatives(Invariants(F)), F); }
  Mat9 projected_d2psi_dF2(const Mat3& F) const {
    return projected_stress_derivative(derivatives(Invariants(F)), F);
  }
  double stiffness() const { return mu + lambda; }

  InvariantDerivatives derivatives(const Invariants& inv) const {
    const double log_J = std::log(inv.J);
    return {.I = 0.5 * mu,
            .J = (lambda * log_J - mu) / inv.J,
            .II = 0.0,
            .IJ = 0.0,
            .JJ = (lambda * (1.0 - log_J) + mu) / (inv.J * inv.J)};
  }
};

}  // namespace lagomorph::sim
