#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/fields.h"
#include "sim/tet_mesh.h"

/// Meshes written with fields beside their geometry.
namespace lagomorph::sim::io {

/// Of a state, what its scalar fields do not tell: of points alone.
struct PointVectors {
  const char* name;
  VecX values;  // 3n
};
struct PointFlags {
  const char* name;
  std::vector<std::uint8_t> values;  // 0 or 1
};

std::string write_vtu(const TetMesh&, const std::vector<Field>&,  // of points and of cells
                      const std::vector<PointVectors>& = {}, const std::vector<PointFlags>& = {});
std::string write_ply(const TriMesh&, const std::vector<Field>&);  // of vertices alone

}  // namespace lagomorph::sim::io
