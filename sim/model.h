#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/damping.h"
#include "sim/energy.h"
#include "sim/held.h"
#include "sim/loads.h"
#include "sim/mass.h"
#include "sim/pins.h"
#include "sim/settings.h"
#include "sim/tet_mesh.h"
#include "sim/types.h"

namespace lagomorph::sim {

/// One body as it comes from its file, and what the scene says of it.
struct BodyInput {
  TetMesh mesh;  // of one body, as checked by check_tet_mesh
  BodySettings settings;
  Points velocities = {};                  // of the file that settings.velocities names, n×3 [m/s]
  std::vector<Recording> recordings = {};  // of each pin, where its settings name a path
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
  double elastic = 0.0;        // Σ vol_j ψ(F_j), and springs
  double gravitational = 0.0;  // -Σ (M g)·q, zero at the origin
  double total() const { return kinetic + elastic + gravitational; }
  double lagrangian() const { return kinetic - elastic - gravitational; }  // L = T - V
};

/// Mesh, mass matrix, energies, pins and loads of a scene. Immutable once built.
class Model {
public:
  /// Places the bodies, merges them, selects the pins, builds M. Throws InputError.
  Model(std::vector<BodyInput> bodies, const Vec3& gravity);

  const TetMesh& mesh() const { return mesh_; }
  SparseMatrix mass() const;                          // M, 3n×3n [kg], made at each call
  VecX mass_times(const VecX& v) const;               // M v
  const VecX& gravity_force() const { return f_g_; }  // M (g, g, ...), 3n [N]
  /// What holds the bodies in a step whose middle is at t: a pin lets go between the steps whose middles are
  /// before and after its release.
  const Held& held(double t) const;
  /// Densities, a body each.
  const std::vector<BodyMass>& masses() const { return masses_; }
  const Pins& pins() const { return held_.front().pins(); }  // at the start
  /// Dead loads f(t), 3n; empty when there are none. [N]
  VecX load_force(double t) const { return loads_.force(t); }
  /// Elasticity, a term for each material model in use, then springs, then gravity.
  const std::vector<std::unique_ptr<Energy>>& energies() const { return energies_; }
  const Damping& damping() const { return damping_; }
  /// Blocks of M and of ∂²V/∂q².
  const std::shared_ptr<const BlockPattern>& pattern() const { return pattern_; }
  /// H += scale · M.
  void add_mass(double scale, BlockHessian& H) const;
  State initial_state() const;  // q = X or the scene's start, velocities of the scene
  Energies energies_of(const State&) const;
  Vec3 momentum(const State&) const;          // Σ (M q̇) by axis [kg m/s]
  Vec3 angular_momentum(const State&) const;  // Σ x × (M q̇), about the origin [kg m²/s]
  double min_J(const VecX& q) const;          // least det F at all quadrature points
  double total_mass() const;                  // [kg]

private:
  void hold(const std::vector<Hold>&, const std::vector<std::string>& names);

  TetMesh mesh_;
  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<BodyMass> masses_;  // a body each
  VecX mass_blocks_;              // each block of M is such a multiple of I
  SparseMatrix vertex_mass_;      // the same as a matrix, n×n: M = vertex_mass ⊗ I
  VecX f_g_;
  std::vector<double> releases_;  // ascending [s]
  std::vector<Held> held_;        // until each of them, and from the last on
  Loads loads_;
  std::vector<std::unique_ptr<Energy>> energies_;
  const Energy* gravity_ = nullptr;
  Damping damping_;
  VecX q0_, qdot0_;
};

}  // namespace lagomorph::sim
