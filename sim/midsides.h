#pragma once

#include <string>

#include "sim/mesh_io.h"
#include "sim/tet_mesh.h"

namespace lagomorph::sim {

/// Checks the midside nodes of quadratic tets: counts, index ranges, and that each edge has one node (or
/// none, in linear tets) in all its tets; where orientation is checked, that it lies in the middle of its
/// straight edge to 1e-4 of the edge's length. Throws InputError.
void check_midsides(const TetMesh&, const std::string& origin, const MeshChecks&);

/// Swaps the last two corners of a tet, which turns it.
void turn_tet(TetMesh&, std::size_t tet);

}  // namespace lagomorph::sim
