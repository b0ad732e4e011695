#include "sim/materials/invariants.h"

#include "sim/materials/stretches.h"

namespace lagomorph::sim {

/// [Smith, de Goes, Kim 2018, "Stable Neo-Hookean Flesh Simulation", Section 4; 2019, "Analytic Eigensystems
/// for Isotropic Distortion Energies"]
Mat9 projected_stress_derivative(const InvariantDerivatives& d, const Mat3& F) {
  const RotationSvd svd(F);
  const Vec3 &s = svd.sigma, g = svd.cofactors();
  StretchEigensystem eigen;
  eigen.twist = (2.0 * d.I + d.J * s.array()).matrix();
  eigen.flip = (2.0 * d.I - d.J * s.array()).matrix();
  eigen.scaling = 4.0 * d.II * s * s.transpose() + 2.0 * d.IJ * (s * g.transpose() + g * s.transpose()) +
                  d.JJ * g * g.transpose();
  eigen.scaling.diagonal().array() += 2.0 * d.I;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    eigen.scaling(i, j) += d.J * s[k];
    eigen.scaling(j, i) += d.J * s[k];
  }
  return without_negative_eigenvalues(stress_derivative(d, F), svd, eigen);
}

}  // namespace lagomorph::sim
