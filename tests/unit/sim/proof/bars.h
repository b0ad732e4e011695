#pragma once

#include <string>

#include "sim/refine.h"
#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {

/// A box of cells from the origin on, of linear or quadratic tets.
inline TetMesh bar_mesh(const Eigen::Vector3i& cells, const Vec3& size, const std::string& element) {
  TetMesh mesh = box_mesh(cells.x(), cells.y(), cells.z(), 1);
  mesh.X = mesh.X * (size.array() / cells.cast<double>().array()).matrix().asDiagonal();
  return element == "quadratic" ? with_quadratic_tets(mesh) : mesh;
}

}  // namespace lagomorph::sim
