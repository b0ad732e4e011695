#include "sim/io/vtk_cells.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "sim/io/formats.h"

namespace lagomorph::sim::io {
namespace {

/// Cells of less than three dimensions. (vtkCellType.h)
constexpr std::array<std::int64_t, 22> kFlatCells = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  21,
                                                     22, 23, 28, 30, 34, 35, 36, 68, 69, 70, 75};

struct Volume {
  std::int64_t type;
  const char* name;
};
constexpr std::array kVolumes = {
    Volume{11, "voxel"},
    Volume{12, "8-node hexahedron"},
    Volume{13, "6-node wedge"},
    Volume{14, "5-node pyramid"},
    Volume{15, "pentagonal prism"},
    Volume{16, "hexagonal prism"},
    Volume{25, "20-node hexahedron"},
    Volume{26, "15-node wedge"},
    Volume{27, "13-node pyramid"},
    Volume{29, "27-node hexahedron"},
    Volume{42, "polyhedron"},
    Volume{71, "Lagrange tetrahedron"},
    Volume{72, "Lagrange hexahedron"},
    Volume{78, "Bezier tetrahedron"},
};

std::string describe(std::int64_t type) {
  const auto* volume =
      std::find_if(kVolumes.begin(), kVolumes.end(), [&](const Volume& v) { return v.type == type; });
  return "type " + std::to_string(type) +
         (volume == kVolumes.end() ? "" : std::string(" (") + volume->name + ")");
}

}  // namespace

std::vector<int> vtk_points(const TetMesh& mesh, std::size_t tet) {
  std::vector<int> points = nodes_of(mesh, tet);
  if (points.size() == 10) std::swap(points[8], points[9]);
  return points;
}

bool is_tag_array(std::string_view name) {
  return name == "tag" || name == "gmsh:physical" || name == "medit:ref" || name == "gmsh%3Aphysical" ||
         name == "medit%3Aref" || name == "CellEntityIds";
}

TetMesh tets_of(const VtkCells& cells, const std::function<void(const std::string&)>& fail) {
  const std::size_t count = cells.types.size();
  if (cells.ends.size() != count) {
    fail(std::to_string(count) + " cell types for " + std::to_string(cells.ends.size()) + " cells");
  }
  if (!cells.tags.empty() && cells.tags.size() != count) {
    fail(std::to_string(cells.tags.size()) + " tags for " + std::to_string(count) + " cells");
  }
  TetMesh mesh;
  const auto points = static_cast<std::int64_t>(cells.points.size() / 3);
  mesh.X = Eigen::Map<const Points>(cells.points.data(), points, 3);
  std::int64_t begin = 0;
  for (std::size_t c = 0; c < count; ++c) {
    const std::int64_t end = cells.ends[c], type = cells.types[c];
    const std::string_view numbered = " (numbered from 0)";
    const auto cell = [&] { return "cell " + std::to_string(c) + std::string(numbered); };
    if (end < begin || end > static_cast<std::int64_t>(cells.connectivity.size())) {
      fail(cell() + " ends at " + std::to_string(end) + " of the connectivity; it must be in " +
           std::to_string(begin) + ".." + std::to_string(cells.connectivity.size()));
    }
    if (type == kVtkTetra || type == kVtkQuadraticTetra) {
      const std::int64_t size = type == kVtkTetra ? 4 : 10;
      if (end - begin != size) {
        fail(cell() + ", a tetrahedron, has " + std::to_string(end - begin) + " points; it must have " +
             std::to_string(size));
      }
      std::vector<int> tet(static_cast<std::size_t>(size));
      for (std::size_t k = 0; k < tet.size(); ++k) {
        const std::int64_t point = cells.connectivity[static_cast<std::size_t>(begin) + k];
        if (point < 0 || point >= points) {
          fail(cell() + " has point " + std::to_string(point) + "; it must be in 0.." +
               std::to_string(points - 1));
        }
        tet[k] = static_cast<int>(point);
      }
      const std::int64_t tag = cells.tags.empty() ? 0 : cells.tags[c];
      if (tag < std::numeric_limits<int>::min() || tag > std::numeric_limits<int>::max()) {
        fail(cell() + " has the tag " + std::to_string(tag) + ", which does not fit 32 bits");
      }
      if (size == 10) std::swap(tet[8], tet[9]);
      add_tet(mesh, tet, static_cast<int>(tag));
    } else if (std::find(kFlatCells.begin(), kFlatCells.end(), type) == kFlatCells.end()) {
      fail(cell() + " is of " + describe(type) +
           "; only tetrahedra of 4 nodes (type 10) or 10 (type 24) can be used for volumes");
    }
    begin = end;
  }
  return mesh;
}

}  // namespace lagomorph::sim::io
