#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/energy.h"
#include "sim/kinematics.h"
#include "sim/settings.h"
#include "sim/tet_mesh.h"

namespace lagomorph::sim {

/// The names that a scene may give as a material's model.
std::vector<std::string> material_names();

/// Throws InputError, prefixed by `where`, for an unknown model (listing the valid ones) or parameters out of
/// range.
void check_material(const MaterialSettings&, const std::string& where);

/// A material and its fibres at one point, whatever the model: for what looks at one F at a time. Bodies have
/// no use for it.
class MaterialPoint {
public:
  virtual ~MaterialPoint() = default;
  virtual double psi(const Mat3& F) const = 0;      // [J/m^3]
  virtual Mat3 dpsi_dF(const Mat3& F) const = 0;    // [Pa]
  virtual Mat9 d2psi_dF2(const Mat3& F) const = 0;  // over row-major vec(F), not projected [Pa]
};

/// Throws InputError as check_material does.
std::unique_ptr<const MaterialPoint> make_material_point(const MaterialSettings&, const std::string& where);

/// What one body is made of.
struct ElasticBody {
  Range tets;
  MaterialSettings material;
  std::string where;  // prefix of error messages
};

/// Elasticity of all bodies: one term for each model and kind of element in use, in the order of
/// material_names(), linear tets first, and then those of all fibres. Throws InputError.
std::vector<std::unique_ptr<Energy>> make_elasticity(const TetMesh&, const std::vector<ElasticBody>&,
                                                     const std::shared_ptr<const BlockPattern>&);

}  // namespace lagomorph::sim
