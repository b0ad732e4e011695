#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace lagomorph::sim {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using VecX = Eigen::VectorXd;
/// n×3 points [m], a row per vertex; its memory is q = (x0 y0 z0 x1 y1 z1 ...).
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

using Tet = std::array<int, 4>;
/// Nodes in the middle of the edges kTetEdges of a quadratic tet.
using Midsides = std::array<int, 6>;
using Triangle = std::array<int, 3>;

/// Corners of a tet's edges, in Gmsh's order of the midside nodes (VTK, Abaqus and Ensight have the last two
/// the other way round).
inline constexpr std::array<std::array<int, 2>, 6> kTetEdges = {
    {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {3, 2}, {3, 1}}};

/// Half-open range [begin, end) of indices.
struct Range {
  int begin = 0;
  int end = 0;
  int size() const { return end - begin; }
};

/// q viewed as n×3 points. q.size() must be a multiple of 3.
inline Eigen::Map<const Points> as_points(const VecX& q) { return {q.data(), q.size() / 3, 3}; }
/// n×3 points viewed as q.
inline Eigen::Map<const VecX> as_q(const Points& X) { return {X.data(), X.size()}; }

}  // namespace lagomorph::sim
