#include "sim/element.h"

#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "sim/elasticity.h"
#include "sim/materials/neo_hookean.h"
#include "sim/materials/stable_neo_hookean.h"
#include "sim/materials/stable_neo_hookean_log.h"
#include "sim/mesh_check.h"
#include "sim/model.h"
#include "sim/refine.h"
#include "sim/statics.h"
#include "tests/support/finite_differences.h"
#include "tests/support/ledger.h"
#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace element_test {

VecX random_vector(Eigen::Index size, unsigned seed, double amount) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-amount, amount);
  return VecX::NullaryExpr(size, [&] { return uniform(random); });
}

VecX rest(const TetMesh& mesh) { return as_q(mesh.X); }

std::vector<int> all_tets(const TetMesh& mesh) {
  std::vector<int> elements(mesh.tets.size());
  for (std::size_t j = 0; j < elements.size(); ++j) elements[j] = static_cast<int>(j);
  return elements;
}

template <class Material>
Elasticity<Material, Tet10> quadratic_term(const TetMesh& mesh,
                                           const std::shared_ptr<const BlockPattern>& pattern) {
  std::vector<Material> materials;
  for (int j = 0; j < mesh.tet_count(); ++j) {
    MaterialSettings settings;
    settings.young = 1e3 * (1 + j % 7);
    materials.push_back(Material::from_settings(settings, "test"));
  }
  return {mesh, all_tets(mesh), materials, pattern};
}

std::shared_ptr<const BlockPattern> pattern_of(const TetMesh& mesh) {
  return std::make_shared<const BlockPattern>(mesh.vertex_count(), mesh.tets, mesh.midsides);
}

TEST(QuadraticTet, ShapeFunctionsAreOneAtTheirNodeAndZeroAtTheOthers) {
  for (int node = 0; node < 10; ++node) {
    Eigen::Vector4d lambda = Eigen::Vector4d::Zero();
    if (node < 4) {
      lambda[node] = 1.0;
    } else {
      for (const int corner : kTetEdges[static_cast<std::size_t>(node - 4)]) lambda[corner] = 0.5;
    }
    const Eigen::Matrix<double, 10, 1> phi = Tet10::phi(lambda);
    for (int a = 0; a < 10; ++a) EXPECT_EQ(phi[a], a == node ? 1.0 : 0.0);
  }
}

/// x = X + a quadratic field: F at each quadrature point is its gradient there, and the volumes add up.
TEST(QuadraticTet, ReproducesQuadraticFields) {
  const TetMesh mesh = with_quadratic_tets(irregular_cube_mesh(2));
  const Mat3 A = (Mat3() << 0.3, -0.2, 0.1, 0.4, 0.2, -0.5, 0.1, 0.6, -0.3).finished();
  const auto x = [&](const Vec3& X) -> Vec3 {
    return X + (A * X).cwiseProduct(X) + 0.5 * X.y() * X.z() * A.col(1);
  };
  const auto F = [&](const Vec3& X) -> Mat3 {
    Mat3 F = Mat3::Identity() + X.asDiagonal() * A;
    F += (A * X).asDiagonal();
    F.col(1) += 0.5 * X.z() * A.col(1);
    F.col(2) += 0.5 * X.y() * A.col(1);
    return F;
  };
  double volume = 0.0;
  for (std::size_t j = 0; j < mesh.tets.size(); ++j) {
    const auto rule = Tet10::rule(mesh, j);
    EXPECT_TRUE(std::is_sorted(rule.nodes.begin(), rule.nodes.end()));
    TetCorners corners;
    for (std::size_t a = 0; a < 4; ++a)
      corners.col(static_cast<Eigen::Index>(a)) = mesh.X.row(mesh.tets[j][a]);
    for (std::size_t p = 0; p < 4; ++p) {
      Mat3 F_h = Mat3::Zero();
      for (std::size_t a = 1; a < 10; ++a)
        F_h += (x(mesh.X.row(rule.nodes[a])) - x(mesh.X.row(rule.nodes[0]))) *
               rule.D[p].row(static_cast<Eigen::Index>(a) - 1);
      EXPECT_LT((F_h - F(corners * Tet10::point(static_cast<int>(p)))).norm(), 1e-13);
      volume += rule.volumes[p];
    }
  }
  EXPECT_NEAR(volume, 1.0, 1e-14);
}

template <class Material>
class QuadraticElasticity : public testing::Test {};
using Materials = testing::Types<NeoHookean, StableNeoHookean, StableNeoHookeanLog>;
TYPED_TEST_SUITE(QuadraticElasticity, Materials);

TYPED_TEST(QuadraticElasticity, DerivativesAreThoseOfTheValueToSecondOrder) {
  const TetMesh mesh = with_quadratic_tets(cube_mesh(2));
  const auto pattern = pattern_of(mesh);
  const auto term = quadratic_term<TypeParam>(mesh, pattern);
  const VecX q = rest(mesh) + random_vector(3 * mesh.vertex_count(), 1, 0.01);
  const VecX dq = random_vector(3 * mesh.vertex_count(), 2, 0.02);
  const auto gradient = [&](double t) {
    VecX g = VecX::Zero(q.size());
    term.add_gradient(q + t * dq, 1.0, g);
    return g;
  };
  ASSERT_LT(term.value(q), 1e9);
  expect_second_order([&](double t) { return term.value(q + t * dq); }, gradient(0.0).dot(dq));
  BlockHessian H(pattern);
  term.add_hessian(q, 1.0, HessianKind::exact, H);
  expect_second_order(gradient, VecX(H.times(dq)));
}

TYPED_TEST(QuadraticElasticity, ABodyDoesNotPushItself) {
  const TetMesh mesh = with_quadratic_tets(cube_mesh(2));
  const auto term = quadratic_term<TypeParam>(mesh, pattern_of(mesh));
  const VecX q = rest(mesh) + random_vector(3 * mesh.vertex_count(), 3, 0.01);
  VecX g = VecX::Zero(q.size());
  term.add_gradient(q, 1.0, g);
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    force += g.segment<3>(3 * v);
    torque += Vec3(q.segment<3>(3 * v)).cross(Vec3(g.segment<3>(3 * v)));
  }
  EXPECT_LT(force.norm(), 1e-12 * g.norm());
  EXPECT_LT(torque.norm(), 1e-12 * g.norm());
}

/// At rest the stiffness of one tet has six motions without energy, the rigid ones, and no others.
TEST(QuadraticElasticityAtRest, HasTheSixRigidMotionsAlone) {
  const TetMesh mesh = with_quadratic_tets(one_tet());
  const auto pattern = pattern_of(mesh);
  BlockHessian H(pattern);
  quadratic_term<StableNeoHookean>(mesh, pattern).add_hessian(rest(mesh), 1.0, HessianKind::exact, H);
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(H.to_sparse().toDense()).eigenvalues();
  EXPECT_LT(eigenvalues.head(6).cwiseAbs().maxCoeff(), 1e-12 * eigenvalues[29]);
  EXPECT_GT(eigenvalues[6], 1e-3 * eigenvalues[29]);
}

TEST(QuadraticElasticityOfNeoHookean, StopsBeforeAnyQuadraturePointInverts) {
  const TetMesh mesh = with_quadratic_tets(one_tet());
  const auto term = quadratic_term<NeoHookean>(mesh, pattern_of(mesh));
  VecX dq = VecX::Zero(30);
  dq[3 * 4] = 2.0;  // the node between corners 0 and 1 goes beyond corner 1; the corners stay
  const double step = term.max_step(rest(mesh), dq);
  EXPECT_LT(step, 1.0);
  EXPECT_TRUE(std::isfinite(term.value(rest(mesh) + step * dq)));
  EXPECT_FALSE(std::isfinite(term.value(rest(mesh) + step / 0.89 * dq)));
}

Model model_of(TetMesh mesh, const std::vector<int>& pinned, const std::string& mass = "consistent") {
  BodySettings settings;
  settings.density = 7.0;
  settings.mass = mass;
  settings.material.young = 1e4;
  settings.material.poisson = 0.4;
  if (!pinned.empty()) settings.pin.emplace_back().vertices = pinned;
  return Model({{std::move(mesh), settings}}, Vec3::Zero());
}

std::vector<int> on_the_border(const TetMesh& mesh) {
  std::vector<int> vertices;
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.X.row(v).minCoeff() == 0.0 || mesh.X.row(v).maxCoeff() == 1.0) vertices.push_back(v);
  return vertices;
}

class PatchTest : public testing::TestWithParam<bool> {};

/// Where the border is deformed as a whole, the inside follows to rounding.
TEST_P(PatchTest, HomogeneousDeformationIsReproduced) {
  TetMesh mesh = irregular_cube_mesh(3);
  if (GetParam()) mesh = with_quadratic_tets(mesh);
  const std::vector<int> border = on_the_border(mesh);
  const Model model = model_of(mesh, border);
  const Mat3 F = (Mat3() << 1.2, 0.1, -0.1, 0.05, 0.9, 0.2, 0.1, -0.15, 1.1).finished();
  Points x = mesh.X * F.transpose();
  const VecX expected = Eigen::Map<const VecX>(x.data(), x.size());
  VecX q = expected + random_vector(expected.size(), 3, 0.01);
  for (const int v : border) q.segment<3>(3 * v) = expected.segment<3>(3 * v);
  SolverSettings settings;
  settings.tolerance = 1e-12;
  ASSERT_TRUE(is_good(static_equilibrium(model, settings, q).status));
  const double worst = (q - expected).cwiseAbs().maxCoeff();
  tell("patch", {"element", "largest error of a position [m]"}, {GetParam() ? "tet10" : "tet4", told(worst)});
  EXPECT_LT(worst, 1e-13);
}
INSTANTIATE_TEST_SUITE_P(Elements, PatchTest, testing::Bool(),
                         [](const auto& info) { return info.param ? "tet10" : "tet4"; });

/// uᵀM v = ρ ∫ u v dX for quadratic u and v: here u = x², v = y z + x, over the unit cube.
TEST(QuadraticMass, IntegratesProductsOfQuadraticFieldsExactly) {
  const TetMesh mesh = with_quadratic_tets(irregular_cube_mesh(2));
  const Model model = model_of(mesh, {});
  EXPECT_NEAR(model.total_mass(), 7.0, 1e-14);
  VecX u = VecX::Zero(3 * mesh.vertex_count()), v = u;
  for (int i = 0; i < mesh.vertex_count(); ++i) {
    const Vec3 X = mesh.X.row(i);
    u[3 * i] = X.x() * X.x();
    v[3 * i] = X.y() * X.z() + X.x();
  }
  EXPECT_NEAR(u.dot(model.mass_times(v)), 7.0 * (1.0 / 3.0 * 0.25 + 0.25), 1e-14);
}

TEST(QuadraticMass, LumpedIsPositiveOnTheDiagonalAndHasTheSameSum) {
  const Model model = model_of(with_quadratic_tets(irregular_cube_mesh(2)), {}, "lumped");
  EXPECT_NEAR(model.total_mass(), 7.0, 1e-14);
  const SparseMatrix M = model.mass();
  EXPECT_EQ(M.nonZeros(), M.rows());
  EXPECT_GT(Eigen::VectorXd(M.diagonal()).minCoeff(), 0.0);
}

TEST(Refined, EightEqualPartsAndTagsStay) {
  for (const bool quadratic : {false, true}) {
    TetMesh mesh = irregular_cube_mesh(2);
    if (quadratic) mesh = with_quadratic_tets(mesh);
    TetMesh fine = refined(mesh);
    Remarks remarks;
    check_tet_mesh(fine, "fine", remarks);
    EXPECT_EQ(remarks, Remarks{});
    EXPECT_EQ(fine.midsides.empty(), !quadratic);
    ASSERT_EQ(fine.tets.size(), 8 * mesh.tets.size());
    EXPECT_EQ(with_linear_tets(fine).vertex_count(), 125);
    EXPECT_EQ(with_quadratic_tets(fine).vertex_count(), 729);
    EXPECT_EQ(fine.X.topRows(mesh.X.rows()), mesh.X);
    const VecX X = rest(fine), X0 = rest(mesh);
    for (std::size_t j = 0; j < fine.tets.size(); ++j) {
      EXPECT_EQ(fine.tags[j], mesh.tags[j / 8]);
      EXPECT_NEAR(tet_volume(gather_corners(X, fine.tets[j])),
                  tet_volume(gather_corners(X0, mesh.tets[j / 8])) / 8.0, 1e-16);
    }
  }
}

/// Splitting again and again makes tets no worse than those of the first split.
TEST(Refined, ShapesStayBounded) {
  TetMesh mesh = one_tet();
  mesh = refined(mesh);
  const double once = quality(mesh).worst_radius_ratio;
  for (int level = 0; level < 3; ++level) mesh = refined(mesh);
  EXPECT_NEAR(quality(mesh).worst_radius_ratio, once, 1e-9);
}

TEST(QuadraticTets, LoseTheirMidsideNodesAgain) {
  const TetMesh mesh = irregular_cube_mesh(2), back = with_linear_tets(with_quadratic_tets(mesh));
  EXPECT_EQ(back.X, mesh.X);
  EXPECT_EQ(back.tets, mesh.tets);
  EXPECT_TRUE(back.midsides.empty());
  EXPECT_EQ(back.bodies[0].vertices.end, mesh.vertex_count());
}

}  // namespace element_test
}  // namespace lagomorph::sim
