#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "sim/element.h"

namespace lagomorph::sim {

/// Linear tets in groups of eight, structure of arrays, for densities ψ(I_C, J): a group's tets are the lanes
/// of vectors, so that the processor's widest instructions do eight at once. What a tet gets does not depend
/// on its neighbours in the group.
class TetLanes {
public:
  static constexpr std::size_t kLanes = 8;
  using Lane = std::array<double, kLanes>;  // a number of each tet of a group

  /// F, cof F and the invariants of each tet.
  struct alignas(64) Deformation {
    std::array<Lane, 9> F, G;  // row by row
    Lane I_C, J;
  };
  /// ∂ψ/∂I_C, ∂ψ/∂J and the second derivatives of each tet. [Pa]
  struct alignas(64) Derivatives {
    Lane I, J, II, IJ, JJ;
  };

  TetLanes() = default;
  explicit TetLanes(const std::vector<ElementRule<4, 1>>& elements);

  std::size_t group_count() const { return groups_.size(); }
  const Lane& volumes(std::size_t group) const { return groups_[group].volumes; }
  void deform(std::size_t group, const VecX& q, Deformation&) const;
  /// vol (∂ψ/∂F) D_a of each tet and node, 12 doubles a tet.
  void set_vectors(std::size_t group, const Deformation&, const Derivatives&, double* vectors) const;
  /// vol Bᵀ (∂²ψ/∂F²) B of each tet in TetGather's order, 90 doubles a tet.
  void set_matrices(std::size_t group, const Deformation&, const Derivatives&, double* matrices) const;

  /// Of group_count() lanes, to the last digits; infinite when one is.
  static double sum(const std::vector<Lane>&);

  struct alignas(64) Group {
    std::array<Lane, 9> D;  // D_ak at 3 (a - 1) + k, of nodes 1 to 3 [1/m]
    Lane volumes;           // [m^3]; zero where there is no tet any more
    std::array<std::array<int, kLanes>, 4> first_dofs;
  };

private:
  std::vector<Group> groups_;
};

}  // namespace lagomorph::sim
