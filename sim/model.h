#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/energy.h"
#include "sim/pins.h"
#include "sim/settings.h"
#include "sim/tet_mesh.h"
#include "sim/types.h"

namespace lagomorph::sim {

/// One body as it comes from its file, and what the scene says of it.
struct BodyInput {
  TetMesh mesh;  // of one body, as checked by check_tet_mesh
  BodySettings settings;
};

/// A full mechanical state at a frame: a value. History holds what a multistep integrator needs, newest
/// first.
struct State {
  int frame = 0;
  double t = 0.0;  // [s]
  VecX q;          // positions, 3n [m]
  VecX qdot;       // velocities, 3n [m/s]
  struct Level {
    double t = 0.0;  // [s]
    VecX q, qdot;
  };
  std::vector<Level> history;  // levels before this one; empty for one-step schemes
};

/// T, V by parts, and T + V. [J]
struct Energies {
  double kinetic = 0.0;        // ½ q̇ᵀMq̇
  double elastic = 0.0;        // Σ vol_j ψ(F_j)
  double gravitational = 0.0;  // -Σ (M g)·q, zero at the origin
  double total() const { return kinetic + elastic + gravitational; }
  double lagrangian() const { return kinetic - elastic - gravitational; }  // L = T - V
};

/// Mesh, mass matrix, energies and pins of a scene. Immutable once built.
class Model {
public:
  /// Places the bodies, merges them, selects the pins, builds M. Throws InputError.
  Model(std::vector<BodyInput> bodies, const Vec3& gravity);

  const TetMesh& mesh() const { return mesh_; }
  SparseMatrix mass() const;                          // M, 3n×3n [kg], made at each call
  VecX mass_times(const VecX& v) const;               // M v
  const VecX& gravity_force() const { return f_g_; }  // M (g, g, ...), 3n [N]
  const Pins& pins() const { return pins_; }
  /// Elasticity, a term for each material model in use, then gravity.
  const std::vector<std::unique_ptr<Energy>>& energies() const { return energies_; }
  /// Blocks of M and of ∂²V/∂q².
  const std::shared_ptr<const BlockPattern>& pattern() const { return pattern_; }
  /// H += scale · M.
  void add_mass(double scale, BlockHessian& H) const;
  State initial_state() const;  // q = X, velocities of the scene
  Energies energies_of(const State&) const;
  Vec3 momentum(const State&) const;  // Σ (M q̇) by axis [kg m/s]
  double total_mass() const;          // [kg]

private:
  TetMesh mesh_;
  std::shared_ptr<const BlockPattern> pattern_;
  VecX mass_blocks_;          // each block of M is such a multiple of I
  SparseMatrix vertex_mass_;  // the same as a matrix, n×n: M = vertex_mass ⊗ I
  VecX f_g_;
  Pins pins_;
  std::vector<std::unique_ptr<Energy>> energies_;
  const Energy* gravity_ = nullptr;
  VecX qdot0_;
};

}  // namespace lagomorph::sim
