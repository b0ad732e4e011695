#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/materials/table.h"
#include "sim/settings.h"
#include "sim/tet_mesh.h"

/// Bodies that are not the same everywhere.
namespace lagomorph::sim {

/// What each tet of a body is made of.
struct Tissue {
  std::vector<ElasticBody> parts;  // runs of tets of one material; cover the body's tets, numbered in it
  std::vector<double> densities;   // of each tet [kg/m^3]; empty: the body's everywhere
};

/// The body's material and density, over them its regions in order, over these its fields in order. `body` is
/// one body's mesh, placed. Throws InputError, prefixed by the place of region or field or by `where`: a
/// region that selects nothing, a field of a wrong length, a value out of range with its file and tet.
Tissue make_tissue(const TetMesh& body, const BodySettings&, const std::string& where);

/// The constants that a field may be of.
std::vector<std::string> field_keys();
/// A constant of a material by its name among field_keys(); none where the material has not been given it, or
/// it is none of a material's.
std::optional<double> constant_of(const MaterialSettings&, const std::string& key);

}  // namespace lagomorph::sim
