#pragma once

#include <array>
#include <vector>

#include "sim/tet_mesh.h"

namespace lagomorph::sim {

/// Most triangles that a subdivided surface may have.
inline constexpr int most_subdivided_triangles = 1 << 22;

/// A surface that was refined by Loop's scheme, and the stencil of its vertices.
struct Subdivision {
  std::vector<Triangle> triangles;  // four for each, level by level, with its orientation
  /// x_fine = stencil x_coarse: a row a fine vertex, non-negative, with the sum 1. The coarse vertices are
  /// the first, moved to where the scheme has them.
  Eigen::SparseMatrix<double, Eigen::RowMajor, int> stencil;
  std::vector<std::array<int, 2>>
      edges;             // fine ones that make up the coarse ones, a coarse edge after the other
  int open_edges = 0;    // coarse ones with one triangle
  int crease_edges = 0;  // and with three or more; both are kept as curves of their own
};

/// Loop's subdivision [Loop 1987, "Smooth Subdivision Surfaces Based on Triangles"]: quartic box splines
/// where six edges meet, tangent-plane continuous elsewhere. A new vertex on an edge is 3/8 of its ends and
/// 1/8 of what is opposite; an old one of n edges keeps 1 - n b and takes b = (5/8 - (3/8 + cos(2 pi / n) /
/// 4)^2) / n of each neighbour. Edges that are not of two triangles become uniform cubic B-splines: 1/2, 1/2
/// on the edge, 1/8, 3/4, 1/8 at a vertex of two such edges; where they end or more of them meet the vertex
/// stays [Hoppe et al. 1994]. Throws InputError for more than most_subdivided_triangles.
Subdivision loop_subdivision(std::vector<Triangle> triangles, int vertex_count, int levels);

}  // namespace lagomorph::sim
