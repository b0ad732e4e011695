#pragma once

#include <vector>

#include "sim/types.h"

namespace lagomorph::sim {

/// What an elastic term knows of each element of the mesh, the mean over its quadrature points.
struct ElementStates {
  std::vector<Mat3> P;            // first Piola-Kirchhoff stress ∂ψ/∂F [Pa]
  std::vector<double> psi;        // energy density [J/m^3]
  std::vector<double> stiffness;  // the size of the material's moduli [Pa]
};

/// A term of V that has stresses.
class StressSource {
public:
  virtual ~StressSource() = default;
  /// Adds its own of its elements at q; the vectors are as long as the mesh has tets.
  virtual void add_states(const VecX& q, ElementStates&) const = 0;
};

}  // namespace lagomorph::sim
