#pragma once

#include <string>
#include <vector>

#include "sim/fields.h"
#include "sim/tet_mesh.h"

/// Meshes written with scalar fields beside their geometry.
namespace lagomorph::sim::io {

std::string write_vtu(const TetMesh&, const std::vector<Field>&);  // of points and of cells
std::string write_ply(const TriMesh&, const std::vector<Field>&);  // of vertices alone

}  // namespace lagomorph::sim::io
