#pragma once

#include <vector>

#include "sim/tet_mesh.h"

namespace lagomorph::sim {

/// Places in `tets`, some of the mesh's, in the order of their rest centroids along a curve that fills space,
/// so that those that follow each other share vertices whatever the mesh's own order. [Morton 1966, "A
/// computer oriented geodetic data base and a new technique in file sequencing"]
std::vector<std::size_t> morton_order(const TetMesh& mesh, const std::vector<int>& tets);

}  // namespace lagomorph::sim
