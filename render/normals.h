#pragma once

#include <span>
#include <vector>

#include "render/types.h"

namespace lagomorph::render {

/// Which triangles meet at each vertex: made once a topology, so that normals are gathered in a fixed order,
/// in parallel.
class VertexNormals {
public:
  VertexNormals(std::span<const Triangle> triangles, std::size_t vertex_count);
  /// Unit vertex normals, triangle normals weighted by the angle at the vertex [Thürmer and Wüthrich 1998].
  /// A vertex with no area around it gets (0, 1, 0). `normals` has vertex_count entries afterwards.
  void compute(std::span<const Triangle> triangles, std::span<const Vec3> positions,
               std::vector<Vec3>& normals) const;

private:
  std::vector<std::uint32_t> first_;    // of each vertex's corners; vertex_count + 1
  std::vector<std::uint32_t> corners_;  // 3 * triangle + corner
};

}  // namespace lagomorph::render
