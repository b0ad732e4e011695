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

inline constexpr Midsides kNoMidsides = {-1, -1, -1, -1, -1, -1};

/// Tetrahedral mesh of all bodies in flat arrays. Tets are positively oriented: det[X1-X0, X2-X0, X3-X0] > 0.
/// A quadratic tet has six nodes more, in the middle of its straight edges.
struct TetMesh {
  Points X;                        // rest positions of corners and midside nodes, n×3 [m]
  std::vector<Tet> tets;           // 0-based vertex indices
  std::vector<Midsides> midsides;  // of each tet, or empty where all are linear; a linear one among quadratic
                                   // ones has kNoMidsides
  std::vector<int> tags;           // physical tag (region) of each tet; same size as tets
  std::vector<Body> bodies;        // cover all vertices and tets, in order

  int vertex_count() const { return static_cast<int>(X.rows()); }
  int tet_count() const { return static_cast<int>(tets.size()); }
  bool is_quadratic(std::size_t tet) const { return !midsides.empty() && midsides[tet][0] >= 0; }
};

/// Triangle mesh, as read from OBJ, OFF, PLY, STL: a fine surface to embed.
struct TriMesh {
  Points X;                         // n×3 [m]
  std::vector<Triangle> triangles;  // counter-clockwise from outside
};

}  // namespace lagomorph::sim
