#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/tet_mesh.h"

namespace lagomorph::sim {

/// What is left of a body that a plane opens: its whole tets whose centroids at rest have
/// (X - point) . normal >= 0, over the same vertices.
TetMesh kept_part(const TetMesh&, int body, const Vec3& point, const Vec3& normal);

/// Triangles that are drawn, and what moves them: x_surface = W x_tets, with W sparse (one entry of 1 a row
/// for the boundary of the tets, φ_i of the tet that holds it for a vertex of an embedded fine mesh, some
/// more where either is subdivided).
class Surface {
public:
  /// Boundary triangles of one body, outward, with their own compact vertex numbering; four for the face of a
  /// quadratic tet.
  static Surface boundary(const TetMesh&, int body);
  /// A fine mesh (in world coordinates of the rest shape) carried by body's tets. Throws InputError when a
  /// fine vertex lies outside of the tets by more than `max_outside` of the body's bounding-box diagonal:
  /// names the vertex, its distance, the limit.
  static Surface embedded(const TetMesh&, int body, const TriMesh& fine, double max_outside = 0.01);

  /// The same of a part of the body's tets, as kept_part() gives it. Triangles that were inside of the body
  /// come last and have corners of their own, so that smooth normals stop at the cut.
  static Surface part(const TetMesh& whole, int body, const TetMesh& kept);

  /// This one refined by Loop's scheme, carried by the stencil times W: fields and motion are by the same
  /// weights. Throws InputError for too many triangles.
  Surface subdivided(int levels) const;

  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Of a subdivided surface the fine edges that its coarse ones became; empty of others.
  const std::vector<std::array<int, 2>>& coarse_edges() const { return coarse_edges_; }
  int open_edges() const { return open_edges_; }              // of what was subdivided, with one triangle
  int crease_edges() const { return crease_edges_; }          // likewise, with three or more
  int first_cut_vertex() const { return first_cut_vertex_; }  // vertex_count() where nothing is cut
  int vertex_count() const { return static_cast<int>(W_.rows()); }
  int outside_count() const { return outside_count_; }  // fine vertices outside of every tet (extrapolated)
  double outside_distance() const { return outside_; }  // the largest distance of one [m]
  /// x = W x_tets, vertex_count×3 [m].
  Points positions(const VecX& q) const;

private:
  using Weights = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;
  std::vector<Triangle> triangles_;
  std::vector<std::array<int, 2>> coarse_edges_;
  int open_edges_ = 0, crease_edges_ = 0;
  Weights W_;  // vertex_count × tet-mesh vertex count
  int first_cut_vertex_ = 0;
  int outside_count_ = 0;
  double outside_ = 0.0;
};

}  // namespace lagomorph::sim
