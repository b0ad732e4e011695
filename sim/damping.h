#pragma once

#include <memory>
#include <vector>

#include "sim/energy.h"
#include "sim/settings.h"
#include "sim/tet_mesh.h"

namespace lagomorph::sim {

/// Forces -C(q) q̇ with C = α M + β K + C_η, positive semi-definite, by body. α M damps all motion, rigid
/// motion too; β K with the projected K = ∂²V/∂q² damps a mode of frequency ω at the rate β ω²/2 (Rayleigh's
/// two), and the rotation of a body under stress a little. C_η is Kelvin and Voigt's viscosity: with the
/// strain rate Ė = sym(FᵀḞ) it turns 2 η |Ė|² per rest volume and second into heat by the stress P = 2 η F Ė,
/// which for small strains is a fluid's 2 η times the rate of strain. Ė is zero for every rigid motion, so
/// none is damped.
class Damping {
public:
  Damping() = default;
  /// `of_bodies` are the mesh's, in order; `mass_blocks` the multiples of assemble_mass(). Throws InputError.
  Damping(const TetMesh&, const std::vector<DampingSettings>& of_bodies, VecX mass_blocks,
          const std::shared_ptr<const BlockPattern>&);

  bool is_none() const { return bodies_.empty(); }
  /// C at q [kg/s]; V = Σ energies must be defined there.
  void assemble(const std::vector<std::unique_ptr<Energy>>& energies, const VecX& q, BlockHessian& C) const;

private:
  struct Body {
    Range blocks;  // of the pattern
    double alpha, beta;
  };
  std::vector<Body> bodies_;  // none when nothing is damped
  bool has_beta_ = false;
  VecX mass_blocks_;
  std::vector<std::unique_ptr<Energy>> viscosity_;  // of each kind of element that has any
};

}  // namespace lagomorph::sim
