#include "sim/mass.h"

#include <algorithm>
#include <span>

#include "sim/element.h"

namespace lagomorph::sim {

namespace {

/// m_rs of one element, the multiples of I.
Eigen::Matrix4d corner_masses(double density, double volume, bool lumped) {
  const double mass = density * volume;
  if (lumped) return mass / 4.0 * Eigen::Matrix4d::Identity();
  return mass / 20.0 * (Eigen::Matrix4d::Ones() + Eigen::Matrix4d::Identity());
}

Mat12 times_identity(const Eigen::Matrix4d& m) {
  Mat12 M = Mat12::Zero();
  for (int r = 0; r < 4; ++r)
    for (int s = 0; s < 4; ++s) M.block<3, 3>(3 * r, 3 * s).diagonal().setConstant(m(r, s));
  return M;
}

/// 420 ∫ φ_r φ_s dX / vol.
int mass_420(int r, int s) {
  if (r < 4 && s < 4) return r == s ? 6 : 1;
  if (r >= 4 && s >= 4) {
    if (r == s) return 32;
    const auto& a = kTetEdges[static_cast<std::size_t>(r - 4)];
    const auto& b = kTetEdges[static_cast<std::size_t>(s - 4)];
    const bool meet = a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
    return meet ? 16 : 8;
  }
  const auto& edge = kTetEdges[static_cast<std::size_t>(std::max(r, s) - 4)];
  const int corner = std::min(r, s);
  return edge[0] == corner || edge[1] == corner ? -4 : -6;
}

template <class Matrix>
void add_masses(std::span<const int> nodes, const Matrix& m, const BlockPattern& pattern, VecX& blocks) {
  for (std::size_t r = 0; r < nodes.size(); ++r)
    for (std::size_t s = r; s < nodes.size(); ++s)
      blocks[pattern.find(std::min(nodes[r], nodes[s]), std::max(nodes[r], nodes[s]))] +=
          m(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(s));
}

}  // namespace

double density_of(const BodyMass& body, int tet) {
  return body.densities.empty() ? body.density : body.densities[static_cast<std::size_t>(tet)];
}

Eigen::Matrix<double, 10, 10> quadratic_masses(double density, double volume) {
  return Eigen::Matrix<double, 10, 10>::NullaryExpr([&](Eigen::Index r, Eigen::Index s) {
    return density * volume / 420.0 * mass_420(static_cast<int>(r), static_cast<int>(s));
  });
}

Eigen::Matrix<double, 10, 10> quadratic_masses_lumped(double density, double volume) {
  Eigen::Matrix<double, 10, 1> m = Eigen::Matrix<double, 10, 1>::Constant(4.0 * density * volume / 27.0);
  m.head<4>().setConstant(density * volume / 36.0);
  return m.asDiagonal();
}

Mat12 element_mass(double density, double volume) {
  return times_identity(corner_masses(density, volume, false));
}

Mat12 element_mass_lumped(double density, double volume) {
  return times_identity(corner_masses(density, volume, true));
}

VecX assemble_mass(const TetMesh& mesh, const std::vector<BodyMass>& bodies, const BlockPattern& pattern) {
  VecX blocks = VecX::Zero(pattern.block_count());
  const VecX X = as_q(mesh.X);
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    for (int j = mesh.bodies[b].tets.begin; j < mesh.bodies[b].tets.end; ++j) {
      const auto index = static_cast<std::size_t>(j);
      const Tet& tet = mesh.tets[index];
      const double density = density_of(bodies[b], j - mesh.bodies[b].tets.begin);
      const double volume = tet_volume(gather_corners(X, tet));
      if (mesh.is_quadratic(index)) {
        add_masses(
            Tet10::nodes_of(mesh, index),
            bodies[b].lumped ? quadratic_masses_lumped(density, volume) : quadratic_masses(density, volume),
            pattern, blocks);
      } else {
        add_masses(tet, corner_masses(density, volume, bodies[b].lumped), pattern, blocks);
      }
    }
  }
  return blocks;
}

SparseMatrix vertex_mass_matrix(const VecX& mass_blocks, const BlockPattern& pattern) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * static_cast<std::size_t>(mass_blocks.size()));
  for (int j = 0; j < pattern.vertex_count(); ++j) {
    for (int k = pattern.starts()[j]; k < pattern.starts()[j + 1]; ++k) {
      const int i = pattern.rows()[k];
      if (mass_blocks[k] == 0.0) continue;
      entries.emplace_back(i, j, mass_blocks[k]);
      if (i != j) entries.emplace_back(j, i, mass_blocks[k]);
    }
  }
  SparseMatrix m(pattern.vertex_count(), pattern.vertex_count());
  m.setFromTriplets(entries.begin(), entries.end());
  return m;
}

}  // namespace lagomorph::sim
