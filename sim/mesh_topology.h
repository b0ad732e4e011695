#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "sim/tet_mesh.h"

/// Which faces, edges and vertices of a mesh meet. All orders are fixed by the mesh alone.
namespace lagomorph::sim {

/// Corners of a tet's four faces, outward when the tet is positively oriented; face k is opposite to corner
/// k.
inline constexpr std::array<std::array<int, 3>, 4> kTetFaces = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

inline Triangle tet_face(const Tet& tet, int k) {
  const auto& face = kTetFaces[static_cast<std::size_t>(k)];
  return {tet[static_cast<std::size_t>(face[0])], tet[static_cast<std::size_t>(face[1])],
          tet[static_cast<std::size_t>(face[2])]};
}

/// The face on the other side of each face. Faces are numbered 4 j + k within the range of tets.
struct FaceMatch {
  static constexpr int kBoundary = -1;  // no other tet has it
  static constexpr int kCrowded = -2;   // more than two tets have it
  std::vector<int> other;               // face number, kBoundary or kCrowded; 4 per tet
  int first_crowded = -1;               // a face of three tets or more
  int first_same_side =
      -1;  // a face whose two tets lie on the same side of it, when they are positively oriented
};
FaceMatch match_faces(const TetMesh&, Range tets);

/// The faces that no other tet has, in the order of the tets.
std::vector<Triangle> boundary_triangles(const TetMesh&, const FaceMatch&, Range tets);

/// The same as it is drawn: of a quadratic tet's face the four triangles between its six nodes.
std::vector<Triangle> drawn_boundary(const TetMesh&, Range tets);

/// A triangle of the boundary, counter-clockwise from outside.
struct BoundaryFace {
  Triangle corners;
  Triangle midsides;  // between corners 0 1, 1 2 and 2 0 of a quadratic tet's; of a linear one's -1
};
std::vector<BoundaryFace> boundary_faces(const TetMesh&, Range tets);

/// Adds the face's triangle, or the four between its six nodes.
void add_drawn(const BoundaryFace&, std::vector<Triangle>&);

/// The midside node of a tet between two of its corners, 0..3. The tet must be quadratic.
int midside(const Midsides&, int a, int b);

/// What there is of edges without exactly two triangles of opposite sense, and of vertices where several fans
/// meet.
struct SurfaceTopology {
  struct Edges {
    int count = 0;
    int a = -1, b = -1;  // the first
  };
  Edges open;          // one triangle
  Edges crowded;       // more than two
  Edges inconsistent;  // two that go along it in the same sense
  int crowded_vertices = 0;
  int first_crowded_vertex = -1;
  bool closed() const { return open.count == 0 && crowded.count == 0; }
};
SurfaceTopology surface_topology(const std::vector<Triangle>&, int vertex_count);

/// For each point the first point with equal coordinates, itself where it is the first; -0 equals 0.
std::vector<int> first_equal_points(const Points&);

}  // namespace lagomorph::sim
