#pragma once

#include <cmath>
#include <limits>

#include "sim/determinant.h"
#include "sim/materials/stretches.h"
#include "sim/settings.h"

namespace lagomorph::sim {

/// ψ = C10 (J^(-2/3) I_1 - 3) + C01 (J^(-4/3) I_2 - 3) + bulk/2 (J - 1)², I_1 = |F|², I_2 = |cof F|².
/// [Mooney 1940; Rivlin 1948; in this compressible form Simo, Taylor 1982 and finite-element programs with
/// bulk = 2/D1] Its shear modulus is 2 (C10 + C01). Not defined for J <= 0, where it is +inf.
struct MooneyRivlin {
  static constexpr const char* kName = "mooney_rivlin";
  static constexpr bool kNeedsPositiveJ = true;
  double C10, C01, bulk;  // [Pa], C10, C01 >= 0, their sum > 0, bulk >= 0

  /// From (C10, C01, bulk), or from (young, poisson) or (mu, lambda) with C10 = 4/5 mu/2, C01 = 1/5 mu/2 and
  /// bulk = lambda + 2mu/3: C01/C10 = 1/4, as rubbers have it.
  static MooneyRivlin from_settings(const MaterialSettings&, const std::string& where);

  double psi(const Mat3& F) const;
  Mat3 dpsi_dF(const Mat3& F) const;
  Mat9 d2psi_dF2(const Mat3& F) const;
  Mat9 projected_d2psi_dF2(const Mat3& F) const;
  double stiffness() const { return 2.0 * (C10 + C01) + bulk; }
};

}  // namespace lagomorph::sim
