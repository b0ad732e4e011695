#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/energy.h"
#include "sim/settings.h"
#include "sim/tet_mesh.h"

namespace lagomorph::sim {

/// The names that a scene may give as a material's model.
std::vector<std::string> material_names();

/// Throws InputError, prefixed by `where`, for an unknown model (listing the valid ones) or parameters out of
/// range.
void check_material(const MaterialSettings&, const std::string& where);

/// What one body is made of.
struct ElasticBody {
  Range tets;
  MaterialSettings material;
  std::string where;  // prefix of error messages
};

/// Elasticity of all bodies: one term for each model in use, in the order of material_names(). Throws
/// InputError.
std::vector<std::unique_ptr<Energy>> make_elasticity(const TetMesh&, const std::vector<ElasticBody>&,
                                                     const std::shared_ptr<const BlockPattern>&);

}  // namespace lagomorph::sim
