#pragma once

#include <vector>

#include "sim/element.h"
#include "sim/shape_functions.h"
#include "sim/tet_mesh.h"

namespace lagomorph::sim {

/// Where a point is among tets.
struct Location {
  int tet = -1;  // index into TetMesh::tets
  Eigen::Vector4d phi =
      Eigen::Vector4d::Zero();  // its shape functions there; extrapolated (some negative) when outside
  double distance = 0.0;        // from the tet; 0 inside [m]
};

/// Finds the tet that holds a point, else the nearest one: a bounding volume hierarchy over the rest shape.
/// The result is a function of the mesh and the point alone.
class PointLocation {
public:
  PointLocation(const TetMesh&, Range tets);  // at least one tet
  /// The tet of smallest distance from X; of several as near, that of lowest index. Distances under 1e-12 of
  /// the bounding box's diagonal count as 0, so that a point on a face is in both its tets.
  Location locate(const Vec3& X) const;

private:
  struct Node {
    Vec3 min, max;   // bounding box [m]
    int begin, end;  // its tets in order_
    int right;       // the right child; the left one is the next node; 0 in a leaf
    int lowest;      // lowest of its tets
  };
  int build(int begin, int end, const std::vector<Vec3>& centroids);

  int first_ = 0;                    // tets are numbered from the first of the range in what follows
  std::vector<Node> nodes_;          // the root first
  std::vector<int> order_;           // tets, leaf by leaf
  std::vector<TetCorners> corners_;  // by tet
  double tolerance_ = 0.0;           // [m]
};

/// Distance of a point from a tet and 0 within, [m]. `phi` are its shape functions there.
double distance_to_tet(const TetCorners&, const Vec3& X, const Eigen::Vector4d& phi);

/// Shape functions of a tet, and their nodes, where its barycentric coordinates are `lambda`: these
/// themselves, or the ten of a quadratic one. Calls add(node, φ).
template <class Add>
void for_each_phi(const TetMesh& mesh, int tet, const Eigen::Vector4d& lambda, Add&& add) {
  const auto j = static_cast<std::size_t>(tet);
  if (!mesh.is_quadratic(j)) {
    for (std::size_t k = 0; k < 4; ++k) add(mesh.tets[j][k], lambda[static_cast<Eigen::Index>(k)]);
    return;
  }
  const std::array<int, 10> nodes = Tet10::nodes_of(mesh, j);
  const Eigen::Matrix<double, 10, 1> phi = Tet10::phi(lambda);
  for (std::size_t k = 0; k < 10; ++k) add(nodes[k], phi[static_cast<Eigen::Index>(k)]);
}

/// x(X) = Σ φ_i(X) x_i at a location. (lecture, "Shape functions")
Vec3 interpolate(const TetMesh&, const Location&, const Eigen::Ref<const Points>& x);

}  // namespace lagomorph::sim
