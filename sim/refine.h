#pragma once

#include "sim/tet_mesh.h"

/// Meshes made from one of a single body: finer, or with elements of another order. Tags are kept, vertices
/// that stay keep their order and come first; new ones are numbered by the tets that first need them.
namespace lagomorph::sim {

/// Quadratic tets: a node in the middle of each edge. A mesh that has them is returned as it is.
TetMesh with_quadratic_tets(const TetMesh&);
/// Linear tets: midside nodes go.
TetMesh with_linear_tets(const TetMesh&);
/// Each tet split in eight of an eighth of its volume: four at its corners, and four around the shortest
/// diagonal of the octahedron that is left, so that elements do not become ever longer. The order stays. [Bey
/// 1995, "Tetrahedral grid refinement"; Zhang 1995, "Successive subdivisions of tetrahedra and multigrid
/// methods on tetrahedral meshes", for the diagonal]
TetMesh refined(const TetMesh&);

}  // namespace lagomorph::sim
