#include "sim/mass.h"

#include <gtest/gtest.h>

#include "tests/support/truth.h"
#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace mass_test {

TEST(ElementMass, MeetsTheReferenceTet) {
  const auto truth = truth::json("2_tet/tet.json");
  const Mat12 M = element_mass(truth.at("rho"), truth.at("vol"));
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j)
      EXPECT_NEAR(M(i, j), truth.at("M0_rowmajor_12x12")[static_cast<std::size_t>(12 * i + j)].get<double>(),
                  1e-14);
}

/// ρ ∫ φ_r φ_s over the tet, by the rule of four points that is exact for quadratic functions.
TEST(ElementMass, IsTheIntegralOfProductsOfShapeFunctions) {
  TetCorners X;
  X << 0.1, 1.3, 0.25, -0.15, -0.2, 0.1, 0.9, 0.3, 0.05, -0.1, 0.2, 1.1;
  const double density = 7.0, volume = tet_volume(X);
  const double a = (5.0 - std::sqrt(5.0)) / 20.0, b = 1.0 - 3.0 * a;
  Eigen::Matrix4d integral = Eigen::Matrix4d::Zero();
  for (int point = 0; point < 4; ++point) {
    Eigen::Vector4d weights = Eigen::Vector4d::Constant(a);
    weights[point] = b;
    const Eigen::Vector4d phi_at_point = phi(X, X * weights);
    integral += 0.25 * volume * density * phi_at_point * phi_at_point.transpose();
  }
  const Mat12 M = element_mass(density, volume);
  for (int r = 0; r < 4; ++r)
    for (int s = 0; s < 4; ++s)
      EXPECT_LT((M.block<3, 3>(3 * r, 3 * s) - integral(r, s) * Mat3::Identity()).norm(), 1e-15);
}

TEST(ElementMass, LumpedHasTheSameSum) {
  const Mat12 M = element_mass_lumped(3.0, 2.0);
  EXPECT_EQ(M.diagonal(), Vec12::Constant(1.5));
  EXPECT_EQ((M - Mat12(M.diagonal().asDiagonal())).norm(), 0.0);
}

TEST(AssembledMass, IsTheSumOfElementsThroughTheirSelections) {
  TetMesh mesh = cube_mesh(2);
  const int half = mesh.tet_count() / 2;
  mesh.bodies = {{"a", {0, mesh.vertex_count()}, {0, half}}, {"b", {0, 0}, {half, mesh.tet_count()}}};
  const BlockPattern pattern(mesh.vertex_count(), mesh.tets);
  const SparseMatrix m =
      vertex_mass_matrix(assemble_mass(mesh, {{5.0, false}, {3.0, true}}, pattern), pattern);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(mesh.vertex_count(), mesh.vertex_count());
  for (int j = 0; j < mesh.tet_count(); ++j) {
    const Tet& tet = mesh.tets[static_cast<std::size_t>(j)];
    const double vol = 1.0 / 48.0;
    const Mat12 M_j = j < half ? element_mass(5.0, vol) : element_mass_lumped(3.0, vol);
    for (int r = 0; r < 4; ++r)
      for (int s = 0; s < 4; ++s)
        expected(tet[static_cast<std::size_t>(r)], tet[static_cast<std::size_t>(s)]) += M_j(3 * r, 3 * s);
  }
  EXPECT_LT((m.toDense() - expected).norm(), 1e-15 * expected.norm() * 10);
  EXPECT_NEAR(m.sum(), 0.5 * 5.0 + 0.5 * 3.0, 1e-14);
}

TEST(AssembledMass, LumpedHasNoEntriesOffTheDiagonal) {
  const TetMesh mesh = cube_mesh(2);
  const BlockPattern pattern(mesh.vertex_count(), mesh.tets);
  const SparseMatrix m = vertex_mass_matrix(assemble_mass(mesh, {{1000.0, true}}, pattern), pattern);
  EXPECT_EQ(m.nonZeros(), mesh.vertex_count());
  EXPECT_NEAR(m.sum(), 1000.0, 1e-10);
}

}  // namespace mass_test
}  // namespace lagomorph::sim
