#pragma once

#include <cstddef>
#include <vector>

#include "sim/types.h"

namespace lagomorph::sim {

/// What an elastic term knows at the quadrature points of all elements of the mesh.
struct PointStates {
  std::vector<std::size_t> first;  // of each element its first point, and at the end the number of all
  std::vector<Mat3> P;             // first Piola-Kirchhoff stress ∂ψ/∂F at each point [Pa]
  std::vector<double> psi;         // energy density at each point [J/m^3]
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
  /// Adds its own at its elements' points at q; `first` is of the whole mesh.
  virtual void add_states(const VecX& q, PointStates&) const = 0;
  /// Adds its own of its elements; the vectors are as long as the mesh has tets.
  virtual void add_moduli(ElementModuli&) const = 0;
};

}  // namespace lagomorph::sim
