#include "sim/energy.h"

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "sim/gravity.h"
#include "sim/springs.h"
#include "tests/support/finite_differences.h"
#include "tests/support/truth.h"
#include "tests/unit/sim/material_rows.h"
#include "tests/unit/sim/mesh_fixtures.h"

/// Each term of the potential: its derivatives by finite differences, and its sums against the slow obvious
/// ones.
namespace lagomorph::sim {
namespace energy_test {

VecX random_vector(Eigen::Index size, unsigned seed, double amount) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-amount, amount);
  return VecX::NullaryExpr(size, [&] { return uniform(random); });
}

VecX rest(const TetMesh& mesh) { return as_q(mesh.X); }

std::shared_ptr<const BlockPattern> pattern_of(const TetMesh& mesh) {
  return std::make_shared<const BlockPattern>(mesh.vertex_count(), mesh.tets);
}

/// A body each of whose tets has its own stiffness.
std::vector<double> young_of(const TetMesh& mesh) {
  std::vector<double> young;
  for (int j = 0; j < mesh.tet_count(); ++j) young.push_back(1e3 * (1 + j % 7));
  return young;
}

std::vector<int> all_tets(const TetMesh& mesh) {
  std::vector<int> elements(mesh.tets.size());
  for (std::size_t j = 0; j < elements.size(); ++j) elements[j] = static_cast<int>(j);
  return elements;
}

struct TermRow {
  std::string name;
  std::function<std::unique_ptr<Energy>(const TetMesh&, const std::shared_ptr<const BlockPattern>&)> make;
};
void PrintTo(const TermRow& row, std::ostream* out) { *out << row.name; }

std::vector<TermRow> all_terms() {
  std::vector<TermRow> rows;
  for (const MaterialRow& material : all_materials())
    rows.push_back({material.name, [&material](const TetMesh& mesh, const auto& pattern) {
                      return material.elasticity(mesh, all_tets(mesh), young_of(mesh), pattern);
                    }});
  rows.push_back({"gravity", [](const TetMesh& mesh, const auto&) {
                    return std::make_unique<Gravity>(random_vector(3 * mesh.vertex_count(), 11, 2.0));
                  }});
  // Stretched, pressed and slack ones, two of them at one vertex.
  rows.push_back({"springs", [](const TetMesh&, const auto&) {
                    return std::make_unique<Springs>(
                        std::vector<Springs::Spring>{{3, 40.0, Vec3(0.2, 0.1, -0.3), 0.0},
                                                     {7, 25.0, Vec3(2.0, 1.0, 0.0), 0.4},
                                                     {7, 60.0, Vec3(0.1, 0.4, 0.6), 5.0}});
                  }});
  return rows;
}

class Terms : public testing::TestWithParam<TermRow> {
protected:
  TetMesh mesh = cube_mesh(2);
  std::shared_ptr<const BlockPattern> pattern = pattern_of(mesh);
  std::unique_ptr<Energy> term = GetParam().make(mesh, pattern);
  VecX q = rest(mesh) + random_vector(3 * mesh.vertex_count(), 1, 0.05);
  VecX dq = random_vector(3 * mesh.vertex_count(), 2, 0.1);
};
INSTANTIATE_TEST_SUITE_P(All, Terms, testing::ValuesIn(all_terms()), NameOfRow());

TEST_P(Terms, GradientIsTheDerivativeOfTheValueToSecondOrder) {
  VecX g = VecX::Zero(q.size());
  term->add_gradient(q, 1.0, g);
  expect_second_order([&](double t) { return term->value(q + t * dq); }, g.dot(dq));
}

TEST_P(Terms, HessianIsTheDerivativeOfTheGradientToSecondOrder) {
  BlockHessian H(pattern);
  const auto gradient = [&](double t) {
    VecX g = VecX::Zero(q.size());
    term->add_gradient(q + t * dq, 1.0, g);
    return g;
  };
  term->add_hessian(q, 1.0, HessianKind::exact, H);
  expect_second_order(gradient, VecX(H.times(dq)));
}

TEST_P(Terms, ScaleAndAddToWhatIsThere) {
  VecX once = VecX::Zero(q.size()), scaled = random_vector(q.size(), 5, 1.0);
  const VecX before = scaled;
  term->add_gradient(q, 1.0, once);
  term->add_gradient(q, -2.5, scaled);
  EXPECT_LT((scaled - (before - 2.5 * once)).norm(), 1e-13 * once.norm());
  BlockHessian H(pattern), H2(pattern);
  term->add_hessian(q, 1.0, HessianKind::exact, H);
  term->add_hessian(q, 2.0, HessianKind::exact, H2);
  term->add_hessian(q, 3.0, HessianKind::exact, H2);
  EXPECT_LT((H2.to_sparse() - 5.0 * H.to_sparse()).norm(), 1e-13 * (1.0 + H.to_sparse().norm()));
}

/// A last digit in each coordinate moves the value by no more than some 1e-15 of its scale.
TEST_P(Terms, ValueScaleIsTheSizeOfItsRounding) {
  const double rounding = 1e-15 * (term->value_scale(q) + std::abs(term->value(q)));
  EXPECT_GT(rounding, 0.0);
  VecX nudged = q;
  for (double& x : nudged) x = std::nextafter(x, 2.0);
  EXPECT_LT(std::abs(term->value(nudged) - term->value(q)), 10.0 * rounding);
}

/// The lecture's formulas as they stand, with E_j as a matrix: V = Σ vol ψ, f = -Σ E_jᵀ vol B_jᵀ vec(P), K =
/// Σ E_jᵀ vol B_jᵀ H B_j E_j.
struct SlowElasticity {
  double V = 0.0;
  VecX g;
  Eigen::MatrixXd K, K_projected;
  SlowElasticity(const TetMesh& mesh, const MaterialRow& row, const std::vector<double>& young, const VecX& q)
      : g(VecX::Zero(q.size())),
        K(Eigen::MatrixXd::Zero(q.size(), q.size())),
        K_projected(Eigen::MatrixXd::Zero(q.size(), q.size())) {
    const VecX X = rest(mesh);
    for (std::size_t j = 0; j < mesh.tets.size(); ++j) {
      const auto material = row.make(young[j], 0.3);
      Eigen::MatrixXd E_j = Eigen::MatrixXd::Zero(12, q.size());
      for (int a = 0; a < 4; ++a)
        E_j.block(3 * a, 3 * mesh.tets[j][static_cast<std::size_t>(a)], 3, 3).setIdentity();
      const Vec12 X_j = E_j * X, q_j = E_j * q;
      const TetCorners corners = Eigen::Map<const TetCorners>(X_j.data());
      const auto B_j = B_matrix(dphi_dX(corners));
      const Vec9 f = B_j * q_j;
      const Mat3 F = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(f.data());
      const double vol = tet_volume(corners);
      V += vol * material->psi(F);
      g += E_j.transpose() * (vol * B_j.transpose() * vec(material->dpsi_dF(F)));
      const Mat9 H = material->d2psi_dF2(F);
      const Eigen::SelfAdjointEigenSolver<Mat9> eigen(H);
      const Mat9 H_projected = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() *
                               eigen.eigenvectors().transpose();
      K += E_j.transpose() * (vol * B_j.transpose() * H * B_j) * E_j;
      K_projected += E_j.transpose() * (vol * B_j.transpose() * H_projected * B_j) * E_j;
    }
  }
};

class ElasticityOf : public testing::TestWithParam<MaterialRow> {};
INSTANTIATE_TEST_SUITE_P(All, ElasticityOf, testing::ValuesIn(all_materials()), NameOfRow());

TEST_P(ElasticityOf, AHeterogeneousBodyEqualsTheSlowSums) {
  const TetMesh mesh = cube_mesh(2);
  const auto pattern = pattern_of(mesh);
  const auto made = GetParam().elasticity(mesh, all_tets(mesh), young_of(mesh), pattern);
  const Energy& term = *made;
  const VecX q =
      0.8 * rest(mesh) + random_vector(3 * mesh.vertex_count(), 3, 0.06);  // compressed: indefinite
  const SlowElasticity slow(mesh, GetParam(), young_of(mesh), q);

  EXPECT_NEAR(term.value(q), slow.V, 1e-14 * slow.V);
  VecX g = VecX::Zero(q.size());
  term.add_gradient(q, 1.0, g);
  EXPECT_LT((g - slow.g).norm(), 1e-14 * slow.g.norm());
  BlockHessian exact(pattern), projected(pattern);
  term.add_hessian(q, 1.0, HessianKind::exact, exact);
  term.add_hessian(q, 1.0, HessianKind::projected, projected);
  EXPECT_LT((exact.to_sparse().toDense() - slow.K).norm(), 1e-14 * slow.K.norm());
  EXPECT_LT((projected.to_sparse().toDense() - slow.K_projected).norm(), 1e-13 * slow.K.norm());
  if (GetParam().is_ever_indefinite) {  // the projection had something to do
    EXPECT_GT((slow.K - slow.K_projected).norm(), 1e-3 * slow.K.norm());
  }
}

TEST_P(ElasticityOf, PartsOfABodyAddUp) {
  const TetMesh mesh = cube_mesh(2);
  const auto pattern = pattern_of(mesh);
  const std::vector<double> young = young_of(mesh);
  std::vector<int> parts[2];
  std::vector<double> young_of_parts[2];
  for (int j = 0; j < mesh.tet_count(); ++j) {
    const std::size_t part = j % 3 == 0;
    parts[part].push_back(j);
    young_of_parts[part].push_back(young[static_cast<std::size_t>(j)]);
  }
  const auto made_whole = GetParam().elasticity(mesh, all_tets(mesh), young, pattern);
  const Energy& whole = *made_whole;
  const VecX q = rest(mesh) + random_vector(3 * mesh.vertex_count(), 3, 0.05);
  double V = 0.0;
  VecX g = VecX::Zero(q.size()), g_whole = g;
  BlockHessian H(pattern), H_whole(pattern);
  for (const std::size_t p : {0u, 1u}) {
    const auto made_part = GetParam().elasticity(mesh, parts[p], young_of_parts[p], pattern);
    const Energy& part = *made_part;
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

TEST_P(ElasticityOf, TheReferenceTetMeetsTheReference) {
  const auto truth = truth::json("2_tet/tet.json");
  const auto& deformed = truth.at("deformed");
  TetMesh mesh = one_tet();
  VecX q(12);
  for (std::size_t i = 0; i < 12; ++i) {
    mesh.X(static_cast<int>(i / 3), static_cast<int>(i % 3)) = truth["X"][i / 3][i % 3];
    q[static_cast<int>(i)] = deformed["q"][i];
  }
  const auto pattern = pattern_of(mesh);
  const auto made = GetParam().elasticity(mesh, {0}, {1e6}, pattern);
  const Energy& term = *made;
  int compared = 0;
  for (const auto& [name, expected] : deformed.at("models").items()) {
    if (!truth::has_model(name) || truth::model_name(name) != GetParam().name) continue;
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
  EXPECT_EQ(compared, GetParam().is_in_truth ? 1 : 0);
}

/// No net force and, where a rotation costs nothing, no net torque from within: Σ f = 0, Σ x × f = 0.
TEST_P(ElasticityOf, ABodyDoesNotPushItself) {
  const TetMesh mesh = cube_mesh(2);
  const auto made = GetParam().elasticity(mesh, all_tets(mesh), young_of(mesh), pattern_of(mesh));
  const Energy& term = *made;
  const VecX q = rest(mesh) + random_vector(3 * mesh.vertex_count(), 3, 0.05);
  VecX g = VecX::Zero(q.size());
  term.add_gradient(q, 1.0, g);
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    force += g.segment<3>(3 * v);
    torque += Vec3(q.segment<3>(3 * v)).cross(Vec3(g.segment<3>(3 * v)));
  }
  EXPECT_LT(force.norm(), 1e-13 * g.norm());
  if (GetParam().is_objective) {
    EXPECT_LT(torque.norm(), 1e-13 * g.norm());
  }
}

TEST_P(ElasticityOf, StopsBeforeATetInvertsWhereItMustNot) {
  const TetMesh mesh = one_tet();
  const auto made = GetParam().elasticity(mesh, {0}, {1e3}, pattern_of(mesh));
  const Energy& term = *made;
  VecX dq = VecX::Zero(12);
  dq[11] = -4.0;  // the top corner, at height 1, reaches the floor after a quarter of the step
  if (!GetParam().needs_positive_J) {
    EXPECT_EQ(term.max_step(rest(mesh), dq), 1.0);
    EXPECT_TRUE(std::isfinite(term.value(rest(mesh) + dq)));
    return;
  }
  EXPECT_NEAR(term.max_step(rest(mesh), dq), 0.9 * 0.25, 1e-15);
  EXPECT_EQ(term.max_step(rest(mesh), -dq), 1.0);
  dq[11] = -0.9;  // not reached, but the margin would be: 0.9 / 0.9 = 1
  EXPECT_NEAR(term.max_step(rest(mesh), dq), 1.0, 1e-15);
  EXPECT_EQ(term.value(rest(mesh) + 2.0 * dq), std::numeric_limits<double>::infinity());
}

TEST(GravityTerm, IsMinusTheForceTimesThePosition) {
  VecX force = VecX::Zero(6), q(6);
  force[1] = -9.81;
  force[4] = -19.62;
  q << 5, 1, 5, 5, 2, 5;
  EXPECT_DOUBLE_EQ(Gravity(force).value(q), 9.81 + 2 * 19.62);
}

}  // namespace energy_test
}  // namespace lagomorph::sim
