#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sim/energy.h"
#include "sim/kinematics.h"
#include "sim/tet_mesh.h"

/// Every material and fibre term, a row each, for the tests that run over all of them.
namespace lagomorph::sim {

/// An energy density whatever its type.
class AnyDensity {
public:
  virtual ~AnyDensity() = default;
  virtual double psi(const Mat3& F) const = 0;
  virtual Mat3 dpsi_dF(const Mat3& F) const = 0;
  virtual Mat9 d2psi_dF2(const Mat3& F) const = 0;
  virtual Mat9 projected_d2psi_dF2(const Mat3& F) const = 0;
};

struct MaterialRow {
  std::string name;
  bool needs_positive_J;
  bool is_isotropic;  // ψ(F R) = ψ(F)
  bool is_objective;  // ψ(R F) = ψ(F)
  bool is_ever_indefinite;
  bool has_rotation;  // R out of F = R S, which jumps where F loses two stretches
  bool is_in_truth;   // tests/data/truth has it
  /// With these moduli; fibres as stiff as young, that push too and lie aslant.
  std::unique_ptr<AnyDensity> (*make)(double young, double poisson);
  /// Elasticity of some elements, each with a Young's modulus of its own and poisson = 0.3.
  std::unique_ptr<Energy> (*elasticity)(const TetMesh&, const std::vector<int>& elements,
                                        const std::vector<double>& young,
                                        const std::shared_ptr<const BlockPattern>&);
};
inline void PrintTo(const MaterialRow& row, std::ostream* out) { *out << row.name; }

const std::vector<MaterialRow>& all_materials();

struct NameOfRow {
  template <class Row>
  std::string operator()(const testing::TestParamInfo<Row>& info) const {
    return info.param.name;
  }
};

}  // namespace lagomorph::sim
