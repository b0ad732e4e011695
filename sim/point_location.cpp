#include "sim/point_location.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include "sim/mesh_topology.h"

namespace lagomorph::sim {
namespace {

constexpr int kLeafSize = 4;

/// Closest point of the triangle ABC to P, by the Voronoi region that P is in.
/// [Ericson, "Real-Time Collision Detection", 2005, section 5.1.5]
Vec3 closest_on_triangle(const Vec3& P, const Vec3& A, const Vec3& B, const Vec3& C) {
  const Vec3 AB = B - A, AC = C - A;
  const double d1 = AB.dot(P - A), d2 = AC.dot(P - A);
  if (d1 <= 0.0 && d2 <= 0.0) return A;
  const double d3 = AB.dot(P - B), d4 = AC.dot(P - B);
  if (d3 >= 0.0 && d4 <= d3) return B;
  const double c = d1 * d4 - d3 * d2;
  if (c <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return A + d1 / (d1 - d3) * AB;
  const double d5 = AB.dot(P - C), d6 = AC.dot(P - C);
  if (d6 >= 0.0 && d5 <= d6) return C;
  const double b = d5 * d2 - d1 * d6;
  if (b <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return A + d2 / (d2 - d6) * AC;
  const double a = d3 * d6 - d5 * d4;
  if (a <= 0.0 && d4 >= d3 && d5 >= d6) return B + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (C - B);
  return A + b / (a + b + c) * AB + c / (a + b + c) * AC;
}

double distance_to_box(const Vec3& X, const Vec3& min, const Vec3& max) {
  return (min - X).cwiseMax(X - max).cwiseMax(0.0).norm();
}

}  // namespace

double distance_to_tet(const TetCorners& corners, const Vec3& X, const Eigen::Vector4d& phi) {
  if (phi.minCoeff() >= 0.0) return 0.0;
  // The closest point of a convex body lies on a face that looks towards X: one whose φ is negative.
  double distance = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 4; ++k) {
    if (phi[k] >= 0.0) continue;
    const auto& face = kTetFaces[static_cast<std::size_t>(k)];
    const Vec3 closest =
        closest_on_triangle(X, corners.col(face[0]), corners.col(face[1]), corners.col(face[2]));
    distance = std::min(distance, (X - closest).norm());
  }
  return distance;
}

PointLocation::PointLocation(const TetMesh& mesh, Range tets) : first_(tets.begin) {
  const auto count = static_cast<std::size_t>(tets.size());
  corners_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Tet& tet = mesh.tets[static_cast<std::size_t>(tets.begin) + i];
    for (std::size_t k = 0; k < 4; ++k) corners_[i].col(static_cast<Eigen::Index>(k)) = mesh.X.row(tet[k]);
  }
  order_.resize(count);
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(count);
  std::vector<Vec3> centroids(count);
  for (std::size_t i = 0; i < count; ++i) centroids[i] = corners_[i].rowwise().mean();
  build(0, static_cast<int>(count), centroids);
  tolerance_ = 1e-12 * (nodes_[0].max - nodes_[0].min).norm();
}

int PointLocation::build(int begin, int end, const std::vector<Vec3>& centroids) {
  const auto index = static_cast<int>(nodes_.size());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Node node{Vec3::Constant(kInfinity),      Vec3::Constant(-kInfinity), begin, end, 0,
            std::numeric_limits<int>::max()};
  Vec3 low = node.min, high = node.max;  // of the centroids
  for (int i = begin; i < end; ++i) {
    const int tet = order_[static_cast<std::size_t>(i)];
    const TetCorners& corners = corners_[static_cast<std::size_t>(tet)];
    node.min = node.min.cwiseMin(corners.rowwise().minCoeff());
    node.max = node.max.cwiseMax(corners.rowwise().maxCoeff());
    node.lowest = std::min(node.lowest, tet);
    low = low.cwiseMin(centroids[static_cast<std::size_t>(tet)]);
    high = high.cwiseMax(centroids[static_cast<std::size_t>(tet)]);
  }
  nodes_.push_back(node);
  if (end - begin <= kLeafSize) return index;
  // The median along the longest axis, equal centroids in the order of their tets.
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int a, int b) {
    return std::pair(centroids[static_cast<std::size_t>(a)][axis], a) <
           std::pair(centroids[static_cast<std::size_t>(b)][axis], b);
  });
  build(begin, middle, centroids);
  nodes_[static_cast<std::size_t>(index)].right = build(middle, end, centroids);
  return index;
}

Location PointLocation::locate(const Vec3& X) const {
  Location best;
  best.distance = std::numeric_limits<double>::infinity();
  // Whether a node may hold a tet nearer than the best, or as near and of lower index.
  const auto may_improve = [&](const Node& node, double distance) {
    return distance <= std::max(best.distance, tolerance_) && (best.distance > 0.0 || node.lowest < best.tet);
  };
  std::array<std::pair<int, double>, 64>
      stack;  // nodes and their distances; the tree is balanced, so 32 levels are never reached
  std::size_t size = 0;
  stack[size++] = {0, distance_to_box(X, nodes_[0].min, nodes_[0].max)};
  while (size > 0) {
    const auto [index, node_distance] = stack[--size];
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    if (!may_improve(node, node_distance)) continue;
    if (node.right == 0) {
      for (int i = node.begin; i < node.end; ++i) {
        const int tet = order_[static_cast<std::size_t>(i)];
        const TetCorners& corners = corners_[static_cast<std::size_t>(tet)];
        const Eigen::Vector4d shape = phi(corners, X);
        double distance = distance_to_tet(corners, X, shape);
        if (distance <= tolerance_) distance = 0.0;
        if (std::pair(distance, tet) < std::pair(best.distance, best.tet)) best = {tet, shape, distance};
      }
      continue;
    }
    const int left = index + 1;
    const auto child = [&](int i) {
      const Node& n = nodes_[static_cast<std::size_t>(i)];
      return std::pair(i, distance_to_box(X, n.min, n.max));
    };
    auto near = child(left), far = child(node.right);
    if (far.second < near.second) std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
  best.tet += first_;
  return best;
}

Vec3 interpolate(const TetMesh& mesh, const Location& location, const Eigen::Ref<const Points>& x) {
  Vec3 result = Vec3::Zero();
  for_each_phi(mesh, location.tet, location.phi,
               [&](int node, double phi) { result += phi * x.row(node).transpose(); });
  return result;
}

}  // namespace lagomorph::sim
