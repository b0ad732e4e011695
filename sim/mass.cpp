#include "sim/mass.h"

#include <algorithm>

namespace lagomorph::sim {

namespace {

/// m_rs of one element, the multiples of I.
Eigen::Matrix4d corner_masses(double density, double volume, bool lumped) {
  const double mass = density * volume;
  if (lumped) return mass / 4.0 * Eigen::Matrix4d::Identity();
  return mass / 20.0 * (Eigen::Matrix4d::Ones() + Eigen::Matrix4d::Identity());
}

double density_of(const BodyMass& body, int tet) {
  return body.densities.empty() ? body.density : body.densities[static_cast<std::size_t>(tet)];
}

Mat12 times_identity(const Eigen::Matrix4d& m) {
  Mat12 M = Mat12::Zero();
  for (int r = 0; r < 4; ++r)
    for (int s = 0; s < 4; ++s) M.block<3, 3>(3 * r, 3 * s).diagonal().setConstant(m(r, s));
  return M;
}

}  // namespace

Mat12 element_mass(double density, double volume) {
  return times_identity(corner_masses(density, volume, false));
}

Mat12 element_mass_lumped(double density, double volume) {
  return times_identity(corner_masses(density, volume, true));
}

VecX assemble_mass(const TetMesh& mesh, const std::vector<BodyMass>& bodies, const BlockPattern& pattern) {
  VecX blocks = VecX::Zero(pattern.block_count());
  const VecX X = Eigen::Map<const VecX>(mesh.X.data(), mesh.X.size());
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    for (int j = mesh.bodies[b].tets.begin; j < mesh.bodies[b].tets.end; ++j) {
      const Tet& tet = mesh.tets[static_cast<std::size_t>(j)];
      const double density = density_of(bodies[b], j - mesh.bodies[b].tets.begin);
      const Eigen::Matrix4d m = corner_masses(density, tet_volume(gather_corners(X, tet)), bodies[b].lumped);
      for (int r = 0; r < 4; ++r)
        for (int s = r; s < 4; ++s)
          blocks[pattern.find(std::min(tet[r], tet[s]), std::max(tet[r], tet[s]))] += m(r, s);
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
