#pragma once

#include <vector>

#include "sim/types.h"

namespace lagomorph::sim {

/// What an elastic term knows of each element of the mesh, the mean over its quadrature points.
struct ElementStates {
  std::vector<Mat3> P;      // first Piola-Kirchhoff stress ∂ψ/∂F [Pa]
  std::vector<double> psi;  // energy density [J/m^3]
};

/// Of each element's moduli C = ∂²ψ/∂F² at F = 1, whose isotropic mean (Voigt's) has C_iijj = 9K and
/// C_ijij = 3K + 10 mu. [Pa]
struct ElementModuli {
  std::vector<double> C_iijj, C_ijij;
};

/// A term of V that has stresses.
class StressSource {
public:
  virtual ~StressSource() = default;
  /// Adds its own of its elements at q; the vectors are as long as the mesh has tets.
  virtual void add_states(const VecX& q, ElementStates&) const = 0;
  virtual void add_moduli(ElementModuli&) const = 0;
};

}  // namespace lagomorph::sim
