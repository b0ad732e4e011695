#pragma once

#include "sim/block_hessian.h"
#include "sim/kinematics.h"
#include "sim/tet_mesh.h"

namespace lagomorph::sim {

/// M_j, 12×12 [kg]: the block of corners (r, s) is ρ vol/20 (1 + δ_rs) I. (lecture, "Mass matrix")
Mat12 element_mass(double density, double volume);
/// The same mass, a quarter at each corner.
Mat12 element_mass_lumped(double density, double volume);

/// m_rs of a quadratic tet, the multiples of I, from ∫ λ_0^i λ_1^j λ_2^k λ_3^l dX = 6 vol i! j! k! l! / (3 +
/// i + j
/// + k + l)!, so exact; nodes as Tet10's. [kg]
Eigen::Matrix<double, 10, 10> quadratic_masses(double density, double volume);
/// The same mass on the diagonal, in proportion to the consistent one's: 1/36 at each corner and 4/27 at each
/// midside node. Sums of rows would be negative at the corners. [Hinton, Rock, Zienkiewicz 1976, "A note on
/// mass lumping and related processes in the finite element method"]
Eigen::Matrix<double, 10, 10> quadratic_masses_lumped(double density, double volume);

struct BodyMass {
  double density = 1000.0;  // [kg/m^3]
  bool lumped = false;
  std::vector<double> densities = {};  // of each tet; empty: `density`
};

/// Of a tet, in the body's numbers. [kg/m^3]
double density_of(const BodyMass&, int tet);

/// M = Σ_j E_jᵀ M_j E_j. Each of its 3×3 blocks is a multiple of I: the multiples, in the pattern's order.
/// [kg]
VecX assemble_mass(const TetMesh&, const std::vector<BodyMass>& bodies, const BlockPattern&);

/// Both triangles of the n×n matrix m with M = m ⊗ I, from assemble_mass's multiples.
SparseMatrix vertex_mass_matrix(const VecX& mass_blocks, const BlockPattern&);

}  // namespace lagomorph::sim
