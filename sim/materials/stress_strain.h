#pragma once

#include <memory>

#include "sim/kinematics.h"
#include "sim/materials/stress_strain_curve.h"
#include "sim/settings.h"

namespace lagomorph::sim {

/// ψ = Σ_i W(log λ_i) + lambda/2 log² J: a density by principal stretches that meets data of uniaxial loading
/// with free sides at its points. Not defined for J <= 0, where it is +inf. For data of T = E log λ it is
/// Hencky's. [Valanis, Landel 1967, "The Strain-Energy Function of a Hyperelastic Material in Terms of the
/// Extension Ratios"; Xu, Sin, Zhu, Barbic 2015, "Nonlinear Material Design Using Principal Stretches"; W and
/// lambda: see StressStrainCurve]
struct StressStrain {
  static constexpr const char* kName = "stress_strain";
  static constexpr bool kNeedsPositiveJ = true;
  std::shared_ptr<const StressStrainCurve> curve;

  static StressStrain from_settings(const MaterialSettings&, const std::string& where);

  double psi(const Mat3& F) const;
  Mat3 dpsi_dF(const Mat3& F) const;
  Mat9 d2psi_dF2(const Mat3& F) const { return hessian(F, false); }
  Mat9 projected_d2psi_dF2(const Mat3& F) const { return hessian(F, true); }
  double stiffness() const;

private:
  Mat9 hessian(const Mat3& F, bool projected) const;
};

}  // namespace lagomorph::sim
