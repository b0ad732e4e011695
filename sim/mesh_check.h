#pragma once

#include <string>
#include <vector>

#include "sim/mesh_io.h"
#include "sim/tet_mesh.h"

namespace lagomorph::sim {

/// Checks counts, index ranges, finite numbers, orientation, overlaps, stray and coincident vertices, and the
/// surface. A mesh inverted throughout is turned and remarked; single inverted or flat tets (volume at most
/// 1e-10 of the longest edge cubed), two tets on the same side of a face, stray vertices, midside nodes off
/// the middle of their edge, indices out of range, NaN throw InputError. Coincident vertices and a surface
/// that is not closed or not manifold are remarked. `origin` is the file's name.
void check_tet_mesh(TetMesh&, const std::string& origin, Remarks&, const MeshChecks& = {});
/// Index ranges and finite numbers throw InputError. Triangles with a corner twice and vertices of no
/// triangle are dropped and remarked; triangles without area, a surface that is not closed, not manifold or
/// not consistently oriented are remarked.
void check_tri_mesh(TriMesh&, const std::string& origin, Remarks&);

/// Only what makes a mesh unusable as data: counts, index ranges, finite numbers, ranges of bodies. Throw
/// InputError.
void validate_tet_mesh(const TetMesh&, const std::string& origin);
void validate_tri_mesh(const TriMesh&, const std::string& origin);

/// Removes vertices that no tet has. Returns how many went.
int drop_stray_vertices(TetMesh&);

/// Merges coincident vertices (exactly equal positions; STL repeats each). Returns how many went.
int weld(TriMesh&);

/// For `info` and assets/README.md.
struct TetMeshQuality {
  double volume = 0.0;  // [m^3]
  double min_dihedral_degrees = 0.0;
  double max_dihedral_degrees = 0.0;
  double volume_ratio = 0.0;                    // smallest over largest tet volume
  double worst_radius_ratio = 0.0;              // 3 r_in / r_circum, 1 for the regular tet; the smallest
  Vec3 min = Vec3::Zero(), max = Vec3::Zero();  // bounding box [m]
  int boundary_triangles = 0;
  bool closed = true;  // each boundary edge has two triangles
};
TetMeshQuality quality(const TetMesh&);

/// Boundary triangles of the tets [begin, end), outward, indexing mesh vertices; in a fixed order.
std::vector<Triangle> boundary_triangles(const TetMesh&, Range tets);

}  // namespace lagomorph::sim
