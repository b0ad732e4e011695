#pragma once

#include <cmath>

#include "sim/kinematics.h"
#include "sim/settings.h"

namespace lagomorph::sim {

/// ψ = mu ε:ε + lambda/2 (tr ε)² with the small strain ε = (F + Fᵀ)/2 - I: for comparison. A turned body
/// swells, as ε takes a rotation for a strain; nothing keeps an element from inverting.
struct LinearElasticity {
  static constexpr const char* kName = "linear";
  static constexpr bool kNeedsPositiveJ = false;
  double mu, lambda;  // [Pa]

  static LinearElasticity from_settings(const MaterialSettings&, const std::string& where);

  double psi(const Mat3& F) const {
    const Mat3 strain = small_strain(F);
    return mu * strain.squaredNorm() + 0.5 * lambda * strain.trace() * strain.trace();
  }
  Mat3 dpsi_dF(const Mat3& F) const {
    const Mat3 strain = small_strain(F);
    return 2.0 * mu * strain + lambda * strain.trace() * Mat3::Identity();
  }
  /// mu (δ_ik δ_jl + δ_il δ_jk) + lambda δ_ij δ_kl, whatever F.
  Mat9 d2psi_dF2(const Mat3&) const {
    const Vec9 one = vec(Mat3::Identity());
    Mat9 H = lambda * one * one.transpose();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        H(3 * i + j, 3 * i + j) += mu;
        H(3 * i + j, 3 * j + i) += mu;
      }
    return H;
  }
  /// Never indefinite: its eigenvalues are 0, 2 mu and 2 mu + 3 lambda.
  Mat9 projected_d2psi_dF2(const Mat3& F) const { return d2psi_dF2(F); }
  double stiffness() const { return mu + std::abs(lambda); }

  static Mat3 small_strain(const Mat3& F) { return 0.5 * (F + F.transpose()) - Mat3::Identity(); }
};

}  // namespace lagomorph::sim
