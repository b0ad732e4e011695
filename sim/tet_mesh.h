#pragma once

#include <string>
#include <vector>

#include "sim/types.h"

namespace lagomorph::sim {

/// A body is a name and the ranges of vertices and tets that are its own.
struct Body {
  std::string name;
  Range vertices;
  Range tets;
};

/// Tetrahedral mesh of all bodies in flat arrays. Tets are positively oriented: det[X1-X0, X2-X0, X3-X0] > 0.
struct TetMesh {
  Points X;                  // rest positions, n×3 [m]
  std::vector<Tet> tets;     // 0-based vertex indices
  std::vector<int> tags;     // physical tag (region) of each tet; same size as tets
  std::vector<Body> bodies;  // cover all vertices and tets, in order

  int vertex_count() const { return static_cast<int>(X.rows()); }
  int tet_count() const { return static_cast<int>(tets.size()); }
};

/// Triangle mesh, as read from OBJ, OFF, PLY, STL: a fine surface to embed.
struct TriMesh {
  Points X;                         // n×3 [m]
  std::vector<Triangle> triangles;  // counter-clockwise from outside
};

}  // namespace lagomorph::sim
