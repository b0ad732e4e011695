#include <array>
#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "sim/determinant.h"
#include "sim/materials/energy_density.h"
#include "sim/materials/neo_hookean.h"
#include "sim/materials/parameters.h"
#include "sim/materials/stable_neo_hookean.h"
#include "sim/materials/stable_neo_hookean_log.h"
#include "sim/materials/table.h"
#include "tests/support/finite_differences.h"
#include "tests/support/truth.h"
#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace {

constexpr double kYoung = 1e6, kPoisson = 0.3;

template <class Material>
Material make(double young = kYoung, double poisson = kPoisson) {
  MaterialSettings settings;
  settings.model = Material::kName;
  settings.young = young;
  settings.poisson = poisson;
  return Material::from_settings(settings, "test");
}

Mat3 matrix(const nlohmann::json& row_major) {
  Mat3 F;
  for (int k = 0; k < 9; ++k) F(k / 3, k % 3) = row_major.at(static_cast<std::size_t>(k)).get<double>();
  return F;
}

Mat3 random_F(unsigned seed, double amount) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-amount, amount);
  return Mat3::Identity() + Mat3::NullaryExpr([&] { return uniform(random); });
}

/// |psi|, |P|, |H| agree to 1e-12 max(mu, max|.|).
template <class Material>
void expect_agrees(const Material& material, const Mat3& F, const nlohmann::json& expected) {
  const double mu = lame_from_young(kYoung, kPoisson).mu;
  const double psi = expected.at("psi");
  EXPECT_NEAR(material.psi(F), psi, 1e-12 * std::max(mu, std::abs(psi)));
  const auto compare = [&](const auto& actual, const nlohmann::json& values, int columns) {
    double largest = mu;
    for (const double value : values) largest = std::max(largest, std::abs(value));
    for (std::size_t k = 0; k < values.size(); ++k) {
      const int row = static_cast<int>(k) / columns, column = static_cast<int>(k) % columns;
      EXPECT_NEAR(actual(row, column), values.at(k).template get<double>(), 1e-12 * largest)
          << row << ' ' << column;
    }
  };
  compare(material.dpsi_dF(F), expected.at("P"), 3);
  compare(material.d2psi_dF2(F), expected.at("H"), 9);
}

template <class Material>
class Materials : public testing::Test {};
using AllMaterials = testing::Types<NeoHookean, StableNeoHookean, StableNeoHookeanLog>;

struct MaterialName {
  template <class Material>
  static std::string GetName(int) {
    return Material::kName;
  }
};
TYPED_TEST_SUITE(Materials, AllMaterials, MaterialName);

TYPED_TEST(Materials, FulfillTheConcept) { static_assert(EnergyDensity<TypeParam>); }

TYPED_TEST(Materials, MeetTheReference) {
  const auto material = make<TypeParam>();
  const auto truth = truth::json("1_constitutive/constitutive.json");
  int compared = 0;
  for (const auto& one : truth.at("cases")) {
    for (const auto& [name, expected] : one.at("models").items()) {
      if (!truth::has_model(name) || truth::model_name(name) != TypeParam::kName) continue;
      SCOPED_TRACE(one.at("name"));
      expect_agrees(material, matrix(one.at("F")), expected);
      ++compared;
    }
  }
  EXPECT_EQ(compared, 10);
}

TYPED_TEST(Materials, KeepTheirPrecisionWhereFIsNearlySingularInvertedOrExtreme) {
  const auto material = make<TypeParam>();
  std::ifstream in(data_path("near_singular/near_singular.json"));
  const auto cases = nlohmann::json::parse(in);
  int compared = 0;
  for (const auto& [name, one] : cases.items()) {
    SCOPED_TRACE(name);
    const Mat3 F = matrix(one.at("F"));
    if (one.at("models").contains(TypeParam::kName)) {
      expect_agrees(material, F, one.at("models").at(TypeParam::kName));
      ++compared;
    } else {
      EXPECT_EQ(material.psi(F), std::numeric_limits<double>::infinity());
    }
  }
  EXPECT_EQ(compared, TypeParam::kNeedsPositiveJ ? 7 : 9);
}

TYPED_TEST(Materials, StressIsTheDerivativeOfTheDensityToSecondOrder) {
  const auto material = make<TypeParam>();
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Mat3 F = random_F(seed, 0.3), dF = random_F(seed + 100, 0.5);
    expect_second_order([&](double t) { return material.psi(F + t * dF); },
                        material.dpsi_dF(F).cwiseProduct(dF).sum());
  }
}

TYPED_TEST(Materials, HessianIsTheDerivativeOfTheStressToSecondOrder) {
  const auto material = make<TypeParam>();
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Mat3 F = random_F(seed, 0.3), dF = random_F(seed + 100, 0.5);
    expect_second_order([&](double t) -> Vec9 { return vec(material.dpsi_dF(F + t * dF)); },
                        Vec9(material.d2psi_dF2(F) * vec(dF)));
  }
}

TYPED_TEST(Materials, HessianIsSymmetric) {
  const Mat9 H = make<TypeParam>().d2psi_dF2(random_F(3, 0.4));
  EXPECT_LT((H - H.transpose()).cwiseAbs().maxCoeff(), 1e-14 * H.cwiseAbs().maxCoeff());
}

/// Also where singular values coincide or vanish, and turned inside out.
TYPED_TEST(Materials, ProjectTheHessianAsItsEigenvaluesClampedAtZero) {
  const auto material = make<TypeParam>();
  std::vector<Mat3> cases = {Mat3::Identity(), 0.5 * Mat3::Identity(), Vec3(0.3, 0.3, 2.0).asDiagonal(),
                             Vec3(1, 1, 1e-7).asDiagonal()};
  for (unsigned seed = 0; seed < 30; ++seed) cases.push_back(random_F(seed, 1.0));
  if (!TypeParam::kNeedsPositiveJ) cases.push_back(Mat3::Zero());
  int projected = 0;
  for (const Mat3& F : cases) {
    if (TypeParam::kNeedsPositiveJ && F.determinant() <= 0.0) continue;
    const Mat9 H = material.d2psi_dF2(F);
    const Eigen::SelfAdjointEigenSolver<Mat9> eigen(H);
    const Mat9 clamped = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() *
                         eigen.eigenvectors().transpose();
    EXPECT_LE((material.projected_d2psi_dF2(F) - clamped).cwiseAbs().maxCoeff(),
              1e-13 * H.cwiseAbs().maxCoeff())
        << F;
    if (eigen.eigenvalues()[0] < -1e-3 * kYoung) ++projected;
  }
  EXPECT_GT(projected, 10);
}

TYPED_TEST(Materials, RestAtTheIdentityAndAnyRotation) {
  const auto material = make<TypeParam>();
  EXPECT_EQ(material.psi(Mat3::Identity()), 0.0);
  EXPECT_LT(material.dpsi_dF(Mat3::Identity()).cwiseAbs().maxCoeff(), 1e-9);
  const Mat3 R = Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  EXPECT_NEAR(material.psi(R), 0.0, 1e-14 * kYoung);
  EXPECT_LT(material.dpsi_dF(R).cwiseAbs().maxCoeff(), 1e-14 * kYoung);
}

TYPED_TEST(Materials, AreObjectiveAndIsotropic) {
  const auto material = make<TypeParam>();
  const Mat3 F = random_F(1, 0.3), R = Eigen::AngleAxisd(0.7, Vec3(1, -2, 3).normalized()).toRotationMatrix();
  EXPECT_NEAR(material.psi(R * F), material.psi(F), 1e-13 * kYoung);
  EXPECT_NEAR(material.psi(F * R), material.psi(F), 1e-13 * kYoung);
  EXPECT_LT((material.dpsi_dF(R * F) - R * material.dpsi_dF(F)).cwiseAbs().maxCoeff(), 1e-13 * kYoung);
}

/// At rest ∂²ψ/∂F² : dF = 2 mu eps + lambda tr(eps) I; the lecture's energy has bulk modulus lambda, hence
/// lambda - 2mu/3 there.
TYPED_TEST(Materials, LineariseToTheirLameConstants) {
  const Lame lame = lame_from_young(kYoung, kPoisson);
  const double lambda =
      std::is_same_v<TypeParam, NeoHookean> ? lame.lambda - 2.0 / 3.0 * lame.mu : lame.lambda;
  const Mat3 dF = random_F(5, 1.0), eps = 0.5 * (dF + dF.transpose());
  const Mat3 sigma = 2.0 * lame.mu * eps + lambda * eps.trace() * Mat3::Identity();
  const Vec9 actual = make<TypeParam>().d2psi_dF2(Mat3::Identity()) * vec(dF);
  EXPECT_LT((actual - vec(sigma)).cwiseAbs().maxCoeff(), 1e-14 * kYoung);
}

/// Homogeneous deformations diag(l1, l2, l3) in closed form; each row starts with what is prescribed.
TYPED_TEST(Materials, MeetHomogeneousDeformations) {
  const auto truth = truth::json("6_analytic/homogeneous.json");
  int compared = 0;
  for (const auto& set : truth.at("sets")) {
    const auto material = make<TypeParam>(set.at("E"), set.at("nu"));
    for (const auto& [name, tests] : set.at("models").items()) {
      if (!truth::has_model(name) || truth::model_name(name) != TypeParam::kName) continue;
      const auto check = [&](double l1, double l2, double l3, const std::array<double, 3>& stresses) {
        const Mat3 P = material.dpsi_dF(Vec3(l1, l2, l3).asDiagonal());
        const double scale = std::max(kYoung, P.cwiseAbs().maxCoeff());
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(P(k, k), stresses[static_cast<std::size_t>(k)], 1e-11 * scale);
        ++compared;
      };
      for (const auto& r : tests.at("uniaxial_free_sides")) check(r[0], r[1], r[1], {r[2], 0.0, 0.0});
      for (const auto& r : tests.at("equibiaxial_free_thickness")) check(r[0], r[0], r[1], {r[2], r[2], 0.0});
      for (const auto& r : tests.at("confined")) check(r[0], 1.0, 1.0, {r[1], r[2], r[2]});
      for (const auto& r : tests.at("hydrostatic")) check(r[0], r[0], r[0], {r[1], r[1], r[1]});
    }
  }
  EXPECT_EQ(compared, 2 * 4 * 7);
}

TEST(NeoHookean, IsInfiniteWhereJIsNotPositive) {
  const auto material = make<NeoHookean>();
  EXPECT_EQ(material.psi(Mat3::Zero()), std::numeric_limits<double>::infinity());
  EXPECT_EQ(material.psi(Vec3(1, 1, -1).asDiagonal()), std::numeric_limits<double>::infinity());
}

TEST(NeoHookean, TakesCAndD) {
  MaterialSettings settings;
  settings.C = 3.0;
  settings.D = 5.0;
  const NeoHookean material = NeoHookean::from_settings(settings, "test");
  EXPECT_EQ(material.C, 3.0);
  EXPECT_EQ(material.D, 5.0);
  const NeoHookean by_lame = make<NeoHookean>();
  EXPECT_EQ(by_lame.C, lame_from_young(kYoung, kPoisson).mu / 2);
  EXPECT_EQ(by_lame.D, lame_from_young(kYoung, kPoisson).lambda / 2);
}

TEST(MaterialTable, NamesItsRows) {
  EXPECT_EQ(material_names(),
            (std::vector<std::string>{"neo_hookean", "stable_neo_hookean", "stable_neo_hookean_log"}));
}

/// What check_material says of a material.
std::string error_with(const std::function<void(MaterialSettings&)>& change) {
  MaterialSettings settings;
  change(settings);
  return error_of([&] { check_material(settings, "here"); });
}

TEST(MaterialTable, TellsWhatIsWrong) {
  using S = MaterialSettings;
  EXPECT_EQ(error_with([](S&) {}), "no error");
  EXPECT_EQ(error_with([](S& s) { s.model = "stvk"; }),
            "here: unknown material model 'stvk'; valid ones are neo_hookean, stable_neo_hookean, "
            "stable_neo_hookean_log");
  EXPECT_EQ(error_with([](S& s) { s.young = 0.0; }), "here: young = 0 must be > 0 Pa");
  EXPECT_EQ(error_with([](S& s) { s.young = INFINITY; }), "here: young = inf must be > 0 Pa");
  EXPECT_EQ(error_with([](S& s) { s.poisson = 0.5; }), "here: poisson = 0.5 must be in (-1, 0.5)");
  EXPECT_EQ(error_with([](S& s) { s.poisson = -1.0; }), "here: poisson = -1 must be in (-1, 0.5)");
  EXPECT_EQ(error_with([](S& s) { s.poisson = NAN; }), "here: poisson = nan must be in (-1, 0.5)");
  EXPECT_EQ(error_with([](S& s) { s.mu = 1.0; }), "here: mu is given without lambda; give both");
  EXPECT_EQ(error_with([](S& s) { s.mu = 1.0, s.lambda = 1.0, s.young = 1.0; }),
            "here: mu and lambda are given beside young or poisson; give one pair");
  EXPECT_EQ(error_with([](S& s) { s.mu = 0.0, s.lambda = 1.0; }), "here: mu = 0 must be > 0 Pa");
  EXPECT_EQ(error_with([](S& s) { s.mu = 3.0, s.lambda = -2.0; }), "here: lambda = -2 must be > -2/3 mu");
  EXPECT_EQ(error_with([](S& s) { s.C = 1.0, s.D = 1.0; }),
            "here: C and D belong to neo_hookean; give young and poisson, or mu and lambda");
  EXPECT_EQ(error_with([](S& s) { s.model = "neo_hookean", s.C = -1.0, s.D = 1.0; }),
            "here: C = -1 must be > 0 Pa");
  EXPECT_EQ(error_with([](S& s) { s.model = "neo_hookean", s.C = 1.0; }),
            "here: C is given without D; give both");
  EXPECT_EQ(error_with([](S& s) { s.model = "neo_hookean", s.poisson = -0.1; }),
            "here: poisson = -0.1 must be in [0, 0.5) for neo_hookean");
}

TEST(Determinant, IsExactWhereItIsTheSmallDifferenceOfLargeProducts) {
  // Vandermonde's determinant (b - a)(c - a)(c - b) = 2, the sum of products of 1e18.
  Mat3 F;
  F.row(0) = Vec3(1, 1e6, 1e12);
  F.row(1) = Vec3(1, 1e6 + 1, 1e12 + 2e6 + 1);
  F.row(2) = Vec3(1, 1e6 + 2, 1e12 + 4e6 + 4);
  EXPECT_EQ(determinant(F), 2.0);
  EXPECT_NE(F.determinant(), 2.0);  // the plain formula loses digits here
}

TEST(Determinant, HasTheCofactorAsDerivative) {
  const Mat3 F = random_F(7, 0.5), dF = random_F(8, 0.5);
  expect_second_order([&](double t) { return determinant(F + t * dF); }, cofactor(F).cwiseProduct(dF).sum());
}

}  // namespace
}  // namespace lagomorph::sim
