#pragma once

#include <concepts>
#include <string>
#include <string_view>

#include "sim/kinematics.h"
#include "sim/settings.h"

namespace lagomorph::sim {

/// A material: the parameters of one element as a value, and its energy density ψ(F) with both derivatives.
template <class Material>
concept EnergyDensity = requires(const Material m, const Mat3& F, const MaterialSettings& s,
                                 const std::string& where) {
  { Material::kName } -> std::convertible_to<std::string_view>;
  /// True when ψ = +inf for J <= 0, so that no step may let an element invert.
  { Material::kNeedsPositiveJ } -> std::convertible_to<bool>;
  /// From the scene's parameters; throws InputError, prefixed by `where`, naming the valid range.
  { Material::from_settings(s, where) } -> std::same_as<Material>;
  { m.psi(F) } -> std::same_as<double>;                // ψ [J/m^3], zero at F = I
  { m.dpsi_dF(F) } -> std::same_as<Mat3>;              // first Piola-Kirchhoff stress [Pa]
  { m.d2psi_dF2(F) } -> std::same_as<Mat9>;            // over row-major vec(F) [Pa]
  { m.projected_d2psi_dF2(F) } -> std::same_as<Mat9>;  // with negative eigenvalues set to zero [Pa]
  { m.stiffness() } -> std::same_as<double>;           // the size of its moduli [Pa]
};

}  // namespace lagomorph::sim
