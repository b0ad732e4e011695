#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/model.h"

namespace lagomorph::sim {

/// Cauchy stress σ = P Fᵀ / J. [Pa]
Mat3 cauchy_stress(const Mat3& P, const Mat3& F);
/// √(3/2 s:s) of a stress, s its deviator: |σ| of a uniaxial one. [Pa]
double von_mises(const Mat3& stress);

struct FieldInfo {
  const char* name;
  const char* unit;  // "" for a pure number
  const char* meaning;
  const char* title;  // as it stands beside a scale
};
/// von_mises, J, energy_density, displacement, young, poisson, density, body.
std::vector<FieldInfo> field_table();
/// Throws InputError that lists the names for one that is none.
const FieldInfo& find_field(std::string_view name);

/// A scalar field of a state, a value an element and a value a vertex.
struct Field {
  FieldInfo info;
  std::vector<double> elements;  // of tets, in their order
  std::vector<double> vertices;  // means, by volume at rest, of what the tets around have at the vertex
};
/// What a quadratic tet has at a vertex is extrapolated from its points; the von Mises stress is that of the
/// mean stress. Fields at positions q (3n), in the order of the names. Throws as find_field does.
std::vector<Field> fields_of(const Model&, const VecX& q, const std::vector<std::string>& names);

}  // namespace lagomorph::sim
