#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/tet_mesh.h"

/// What the readers of VTK's legacy and XML files share.
namespace lagomorph::sim::io {

/// An unstructured grid as the files hold it.
struct VtkCells {
  std::vector<double> points;              // x0 y0 z0 x1 ...
  std::vector<std::int64_t> connectivity;  // points of all cells
  std::vector<std::int64_t> ends;          // where each cell's points end in it
  std::vector<std::int64_t> types;
  std::vector<std::int64_t> tags;  // one a cell, or none
};

/// The tetrahedra of a grid; cells of lower dimension are left out. `fail` reports a message at the file's
/// place and throws: for a volume that is no tetrahedron of 4 or 10 nodes, and for points, ends or counts
/// that do not fit.
TetMesh tets_of(const VtkCells&, const std::function<void(const std::string&)>& fail);

constexpr std::int64_t kVtkTetra = 10, kVtkQuadraticTetra = 24;

/// The 4 or 10 points of a tet as VTK orders them: it has the last two midside nodes the other way round.
std::vector<int> vtk_points(const TetMesh&, std::size_t tet);
inline std::int64_t vtk_type(const TetMesh& mesh, std::size_t tet) {
  return mesh.is_quadratic(tet) ? kVtkQuadraticTetra : kVtkTetra;
}

/// Whether a cell array of this name holds the tags: "tag" is ours, the others those of meshio and Gmsh.
bool is_tag_array(std::string_view name);

}  // namespace lagomorph::sim::io
