#include "sim/energy.h"

#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "sim/elasticity.h"
#include "sim/gravity.h"
#include "sim/materials/neo_hookean.h"
#include "sim/materials/stable_neo_hookean.h"
#include "sim/materials/stable_neo_hookean_log.h"
#include "sim/springs.h"
#include "tests/support/finite_differences.h"
#include "tests/support/truth.h"
#include "tests/unit/sim/mesh_fixtures.h"

/// Each term of the potential: its derivatives by finite differences, and its sums against the slow obvious
/// ones.
namespace lagomorph::sim {
namespace {

VecX random_vector(Eigen::Index size, unsigned seed, double amount) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-amount, amount);
  return VecX::NullaryExpr(size, [&] { return uniform(random); });
}

VecX rest(const TetMesh& mesh) { return Eigen::Map<const VecX>(mesh.X.data(), mesh.X.size()); }

std::shared_ptr<const BlockPattern> pattern_of(const TetMesh& mesh) {
  return std::make_shared<const BlockPattern>(mesh.vertex_count(), mesh.tets);
}

template <class Material>
Material material_with(double young) {
  MaterialSettings settings;
  settings.young = young;
  return Material::from_settings(settings, "test");
}

/// A body each of whose tets has its own stiffness.
template <class Material>
std::vector<Material> materials_of(const TetMesh& mesh) {
  std::vector<Material> materials;
  for (int j = 0; j < mesh.tet_count(); ++j) materials.push_back(material_with<Material>(1e3 * (1 + j % 7)));
  return materials;
}

std::vector<int> all_tets(const TetMesh& mesh) {
  std::vector<int> elements(mesh.tets.size());
  for (std::size_t j = 0; j < elements.size(); ++j) elements[j] = static_cast<int>(j);
  return elements;
}

template <class Material>
struct MakeElasticity {
  static constexpr const char* kName = Material::kName;
  std::unique_ptr<Energy> operator()(const TetMesh& mesh,
                                     const std::shared_ptr<const BlockPattern>& pattern) const {
    return std::make_unique<Elasticity<Material>>(mesh, all_tets(mesh), materials_of<Material>(mesh),
                                                  pattern);
  }
};
struct MakeGravity {
  static constexpr const char* kName = "gravity";
  std::unique_ptr<Energy> operator()(const TetMesh& mesh, const std::shared_ptr<const BlockPattern>&) const {
    return std::make_unique<Gravity>(random_vector(3 * mesh.vertex_count(), 11, 2.0));
  }
};

/// Stretched, pressed and slack ones, two of them at one vertex.
struct MakeSprings {
  static constexpr const char* kName = "springs";
  std::unique_ptr<Energy> operator()(const TetMesh&, const std::shared_ptr<const BlockPattern>&) const {
    return std::make_unique<Springs>(std::vector<Springs::Spring>{{3, 40.0, Vec3(0.2, 0.1, -0.3), 0.0},
                                                                  {7, 25.0, Vec3(2.0, 1.0, 0.0), 0.4},
                                                                  {7, 60.0, Vec3(0.1, 0.4, 0.6), 5.0}});
  }
};

template <class Make>
class Terms : public testing::Test {
protected:
  TetMesh mesh = cube_mesh(2);
  std::shared_ptr<const BlockPattern> pattern = pattern_of(mesh);
  std::unique_ptr<Energy> term = Make()(mesh, pattern);
  VecX q = rest(mesh) + random_vector(3 * mesh.vertex_count(), 1, 0.05);
  VecX dq = random_vector(3 * mesh.vertex_count(), 2, 0.1);
};
using AllTerms = testing::Types<MakeElasticity<NeoHookean>, MakeElasticity<StableNeoHookean>,
                                MakeElasticity<StableNeoHookeanLog>, MakeGravity, MakeSprings>;
struct TermName {
  template <class Make>
  static std::string GetName(int) {
    return Make::kName;
  }
};
TYPED_TEST_SUITE(Terms, AllTerms, TermName);

TYPED_TEST(Terms, GradientIsTheDerivativeOfTheValueToSecondOrder) {
  VecX g = VecX::Zero(this->q.size());
  this->term->add_gradient(this->q, 1.0, g);
  expect_second_order([&](double t) { return this->term->value(this->q + t * this->dq); }, g.dot(this->dq));
}

TYPED_TEST(Terms, HessianIsTheDerivativeOfTheGradientToSecondOrder) {
  BlockHessian H(this->pattern);
  const auto gradient = [&](double t) {
    VecX g = VecX::Zero(this->q.size());
    this->term->add_gradient(this->q + t * this->dq, 1.0, g);
    return g;
  };
  this->term->add_hessian(this->q, 1.0, HessianKind::exact, H);
  expect_second_order(gradient, VecX(H.times(this->dq)));
}

TYPED_TEST(Terms, ScaleAndAddToWhatIsThere) {
  VecX once = VecX::Zero(this->q.size()), scaled = random_vector(this->q.size(), 5, 1.0);
  const VecX before = scaled;
  this->term->add_gradient(this->q, 1.0, once);
  this->term->add_gradient(this->q, -2.5, scaled);
  EXPECT_LT((scaled - (before - 2.5 * once)).norm(), 1e-13 * once.norm());
  BlockHessian H(this->pattern), H2(this->pattern);
  this->term->add_hessian(this->q, 1.0, HessianKind::exact, H);
  this->term->add_hessian(this->q, 2.0, HessianKind::exact, H2);
  this->term->add_hessian(this->q, 3.0, HessianKind::exact, H2);
  EXPECT_LT((H2.to_sparse() - 5.0 * H.to_sparse()).norm(), 1e-13 * (1.0 + H.to_sparse().norm()));
}

/// A last digit in each coordinate moves the value by no more than some 1e-15 of its scale.
TYPED_TEST(Terms, ValueScaleIsTheSizeOfItsRounding) {
  const double rounding = 1e-15 * (this->term->value_scale(this->q) + std::abs(this->term->value(this->q)));
  EXPECT_GT(rounding, 0.0);
  VecX nudged = this->q;
  for (double& x : nudged) x = std::nextafter(x, 2.0);
  EXPECT_LT(std::abs(this->term->value(nudged) - this->term->value(this->q)), 10.0 * rounding);
}

/// The lecture's formulas as they stand, with E_j as a matrix: V = Σ vol ψ, f = -Σ E_jᵀ vol B_jᵀ vec(P), K =
/// Σ E_jᵀ vol B_jᵀ H B_j E_j.
template <class Material>
struct SlowElasticity {
  double V = 0.0;
  VecX g;
  Eigen::MatrixXd K, K_projected;
  SlowElasticity(const TetMesh& mesh, const std::vector<Material>& materials, const VecX& q)
      : g(VecX::Zero(q.size())),
        K(Eigen::MatrixXd::Zero(q.size(), q.size())),
        K_projected(Eigen::MatrixXd::Zero(q.size(), q.size())) {
    const VecX X = rest(mesh);
    for (std::size_t j = 0; j < mesh.tets.size(); ++j) {
      Eigen::MatrixXd E_j = Eigen::MatrixXd::Zero(12, q.size());
      for (int a = 0; a < 4; ++a)
        E_j.block(3 * a, 3 * mesh.tets[j][static_cast<std::size_t>(a)], 3, 3).setIdentity();
      const Vec12 X_j = E_j * X, q_j = E_j * q;
      const TetCorners corners = Eigen::Map<const TetCorners>(X_j.data());
      const auto B_j = B_matrix(dphi_dX(corners));
      const Vec9 f = B_j * q_j;
      const Mat3 F = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(f.data());
      const double vol = tet_volume(corners);
      V += vol * materials[j].psi(F);
      g += E_j.transpose() * (vol * B_j.transpose() * vec(materials[j].dpsi_dF(F)));
      const Mat9 H = materials[j].d2psi_dF2(F);
      const Eigen::SelfAdjointEigenSolver<Mat9> eigen(H);
      const Mat9 H_projected = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() *
                               eigen.eigenvectors().transpose();
      K += E_j.transpose() * (vol * B_j.transpose() * H * B_j) * E_j;
      K_projected += E_j.transpose() * (vol * B_j.transpose() * H_projected * B_j) * E_j;
    }
  }
};

template <class Material>
class ElasticityOf : public testing::Test {};
using AllMaterials = testing::Types<NeoHookean, StableNeoHookean, StableNeoHookeanLog>;
TYPED_TEST_SUITE(ElasticityOf, AllMaterials, TermName);

TYPED_TEST(ElasticityOf, AHeterogeneousBodyEqualsTheSlowSums) {
  const TetMesh mesh = cube_mesh(2);
  const auto pattern = pattern_of(mesh);
  const auto materials = materials_of<TypeParam>(mesh);
  const Elasticity<TypeParam> term(mesh, all_tets(mesh), materials, pattern);
  const VecX q =
      0.8 * rest(mesh) + random_vector(3 * mesh.vertex_count(), 3, 0.06);  // compressed: indefinite
  const SlowElasticity<TypeParam> slow(mesh, materials, q);

  EXPECT_NEAR(term.value(q), slow.V, 1e-14 * slow.V);
  VecX g = VecX::Zero(q.size());
  term.add_gradient(q, 1.0, g);
  EXPECT_LT((g - slow.g).norm(), 1e-14 * slow.g.norm());
  BlockHessian exact(pattern), projected(pattern);
  term.add_hessian(q, 1.0, HessianKind::exact, exact);
  term.add_hessian(q, 1.0, HessianKind::projected, projected);
  EXPECT_LT((exact.to_sparse().toDense() - slow.K).norm(), 1e-14 * slow.K.norm());
  EXPECT_LT((projected.to_sparse().toDense() - slow.K_projected).norm(), 1e-13 * slow.K.norm());
  EXPECT_GT((slow.K - slow.K_projected).norm(), 1e-3 * slow.K.norm());  // the projection had something to do
}

TYPED_TEST(ElasticityOf, PartsOfABodyAddUp) {
  const TetMesh mesh = cube_mesh(2);
  const auto pattern = pattern_of(mesh);
  const auto materials = materials_of<TypeParam>(mesh);
  std::vector<int> parts[2];
  std::vector<TypeParam> materials_of_parts[2];
  for (int j = 0; j < mesh.tet_count(); ++j) {
    const std::size_t part = j % 3 == 0;
    parts[part].push_back(j);
    materials_of_parts[part].push_back(materials[static_cast<std::size_t>(j)]);
  }
  const Elasticity<TypeParam> whole(mesh, all_tets(mesh), materials, pattern);
  const VecX q = rest(mesh) + random_vector(3 * mesh.vertex_count(), 3, 0.05);
  double V = 0.0;
  VecX g = VecX::Zero(q.size()), g_whole = g;
  BlockHessian H(pattern), H_whole(pattern);
  for (const std::size_t p : {0u, 1u}) {
    const Elasticity<TypeParam> part(mesh, parts[p], materials_of_parts[p], pattern);
    V += part.value(q);
    part.add_gradient(q, 1.0, g);
    part.add_hessian(q, 1.0, HessianKind::exact, H);
  }
  whole.add_gradient(q, 1.0, g_whole);
  whole.add_hessian(q, 1.0, HessianKind::exact, H_whole);
  EXPECT_NEAR(V, whole.value(q), 1e-14 * V);
  EXPECT_LT((g - g_whole).norm(), 1e-14 * g_whole.norm());
  EXPECT_LT((H.to_sparse() - H_whole.to_sparse()).norm(), 1e-14 * H_whole.to_sparse().norm());
}

TYPED_TEST(ElasticityOf, TheReferenceTetMeetsTheReference) {
  const auto truth = truth::json("2_tet/tet.json");
  const auto& deformed = truth.at("deformed");
  TetMesh mesh = one_tet();
  VecX q(12);
  for (std::size_t i = 0; i < 12; ++i) {
    mesh.X(static_cast<int>(i / 3), static_cast<int>(i % 3)) = truth["X"][i / 3][i % 3];
    q[static_cast<int>(i)] = deformed["q"][i];
  }
  const auto pattern = pattern_of(mesh);
  const Elasticity<TypeParam> term(mesh, {0}, {material_with<TypeParam>(1e6)}, pattern);
  int compared = 0;
  for (const auto& [name, expected] : deformed.at("models").items()) {
    if (!truth::has_model(name) || truth::model_name(name) != TypeParam::kName) continue;
    const double V = expected.at("V");
    EXPECT_NEAR(term.value(q), V, 1e-12 * V);
    VecX f = VecX::Zero(12), f_expected(12);
    term.add_gradient(q, -1.0, f);
    Eigen::MatrixXd K_expected(12, 12);
    for (std::size_t i = 0; i < 12; ++i) f_expected[static_cast<int>(i)] = expected.at("f_int_minus_dVdq")[i];
    for (std::size_t i = 0; i < 144; ++i)
      K_expected(static_cast<int>(i / 12), static_cast<int>(i % 12)) =
          expected.at("K_d2Vdq2_rowmajor_12x12")[i];
    BlockHessian K(pattern);
    term.add_hessian(q, 1.0, HessianKind::exact, K);
    EXPECT_LT((f - f_expected).cwiseAbs().maxCoeff(), 1e-12 * f_expected.cwiseAbs().maxCoeff());
    EXPECT_LT((K.to_sparse().toDense() - K_expected).cwiseAbs().maxCoeff(),
              1e-12 * K_expected.cwiseAbs().maxCoeff());
    ++compared;
  }
  EXPECT_EQ(compared, 1);
}

/// No net force and no net torque from within: Σ f = 0, Σ x × f = 0.
TYPED_TEST(ElasticityOf, ABodyDoesNotPushItself) {
  const TetMesh mesh = cube_mesh(2);
  const Elasticity<TypeParam> term(mesh, all_tets(mesh), materials_of<TypeParam>(mesh), pattern_of(mesh));
  const VecX q = rest(mesh) + random_vector(3 * mesh.vertex_count(), 3, 0.05);
  VecX g = VecX::Zero(q.size());
  term.add_gradient(q, 1.0, g);
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    force += g.segment<3>(3 * v);
    torque += Vec3(q.segment<3>(3 * v)).cross(Vec3(g.segment<3>(3 * v)));
  }
  EXPECT_LT(force.norm(), 1e-13 * g.norm());
  EXPECT_LT(torque.norm(), 1e-13 * g.norm());
}

TEST(ElasticityOfNeoHookean, StopsBeforeATetInverts) {
  const TetMesh mesh = one_tet();
  const Elasticity<NeoHookean> term(mesh, {0}, {material_with<NeoHookean>(1e3)}, pattern_of(mesh));
  VecX dq = VecX::Zero(12);
  dq[11] = -4.0;  // the top corner, at height 1, reaches the floor after a quarter of the step
  EXPECT_NEAR(term.max_step(rest(mesh), dq), 0.9 * 0.25, 1e-15);
  EXPECT_EQ(term.max_step(rest(mesh), -dq), 1.0);
  dq[11] = -0.9;  // not reached, but the margin would be: 0.9 / 0.9 = 1
  EXPECT_NEAR(term.max_step(rest(mesh), dq), 1.0, 1e-15);
  EXPECT_EQ(term.value(rest(mesh) + 2.0 * dq), std::numeric_limits<double>::infinity());
}

TEST(ElasticityOfStableNeoHookean, MayInvert) {
  const TetMesh mesh = one_tet();
  const Elasticity<StableNeoHookean> term(mesh, {0}, {material_with<StableNeoHookean>(1e3)},
                                          pattern_of(mesh));
  VecX dq = VecX::Zero(12);
  dq[11] = -4.0;
  EXPECT_EQ(term.max_step(rest(mesh), dq), 1.0);
  EXPECT_TRUE(std::isfinite(term.value(rest(mesh) + dq)));
}

TEST(SpringsTerm, HaveAProjectedHessianWithoutNegativePart) {
  const TetMesh mesh = cube_mesh(1);
  const auto pattern = pattern_of(mesh);
  const Springs springs({{0, 10.0, Vec3(0, 0, 1), 3.0}, {1, 10.0, mesh.X.row(1).transpose(), 3.0}});
  BlockHessian exact(pattern), projected(pattern);
  springs.add_hessian(rest(mesh), 1.0, HessianKind::exact, exact);
  springs.add_hessian(rest(mesh), 1.0, HessianKind::projected, projected);
  const int pressed = pattern->find(0, 0);  // to a third of its length: k (1 - 3) across, k along
  EXPECT_EQ(Mat3(exact.block(pressed)), Mat3(Vec3(-20, -20, 10).asDiagonal()));
  EXPECT_EQ(Mat3(projected.block(pressed)), Mat3(Vec3(0, 0, 10).asDiagonal()));
  // Of no length it has no direction: it does not push, and is told by its stiffness.
  VecX g = VecX::Zero(24);
  springs.add_gradient(rest(mesh), 1.0, g);
  EXPECT_EQ(Vec3(g.segment<3>(0)), Vec3(0, 0, 20));  // -g pushes it away from its point
  EXPECT_EQ(Vec3(g.segment<3>(3)), Vec3::Zero());
  EXPECT_EQ(Mat3(projected.block(pattern->find(1, 1))), Mat3(10.0 * Mat3::Identity()));
  EXPECT_EQ(springs.value(rest(mesh)), 0.5 * 10 * 4 + 0.5 * 10 * 9);
}

TEST(GravityTerm, IsMinusTheForceTimesThePosition) {
  VecX force = VecX::Zero(6), q(6);
  force[1] = -9.81;
  force[4] = -19.62;
  q << 5, 1, 5, 5, 2, 5;
  EXPECT_DOUBLE_EQ(Gravity(force).value(q), 9.81 + 2 * 19.62);
}

}  // namespace
}  // namespace lagomorph::sim
