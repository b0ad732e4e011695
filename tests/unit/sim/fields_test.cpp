#include "sim/fields.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "sim/io/field_writers.h"
#include "sim/kinematics.h"
#include "sim/materials/table.h"
#include "sim/refine.h"
#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace fields_test {

constexpr double kMu = 3e5, kLambda = 7e5;

BodyInput cube_body(int n, const std::string& model = "neo_hookean") {
  BodyInput body{cube_mesh(n), {}};
  body.settings.material = {};
  body.settings.material.model = model;
  body.settings.material.mu = kMu;
  body.settings.material.lambda = kLambda;
  return body;
}

/// q = A X.
VecX mapped(const Model& model, const Mat3& A) {
  VecX q = model.initial_state().q;
  for (Eigen::Index v = 0; v < q.size() / 3; ++v) q.segment<3>(3 * v) = A * q.segment<3>(3 * v);
  return q;
}

/// σ of the Neo-Hookean of the lecture at the principal stretches: ψ = mu/2 (J^(-2/3) I_C - 3) + lambda/2
/// (J - 1)^2, so σ = mu J^(-5/3) (b - tr(b)/3 I) + lambda (J - 1) I.
Vec3 neo_hookean_stress(const Vec3& stretch) {
  const double J = stretch.prod();
  const Vec3 b = stretch.cwiseAbs2();
  return kMu * std::pow(J, -5.0 / 3) * (b - Vec3::Constant(b.sum() / 3)) + Vec3::Constant(kLambda * (J - 1));
}

TEST(Fields, VonMisesIsTheStressOfUniaxialLoading) {
  Mat3 stress = Mat3::Zero();
  stress(1, 1) = -5;
  EXPECT_DOUBLE_EQ(von_mises(stress), 5);
  EXPECT_NEAR(von_mises(7 * Mat3::Identity()), 0, 1e-14);
  stress.setZero();
  stress(0, 1) = stress(1, 0) = 2;
  EXPECT_DOUBLE_EQ(von_mises(stress), 2 * std::sqrt(3.0));
}

TEST(Fields, OfAUniaxialStretchAreItsClosedForms) {
  const Model model({cube_body(2)}, Vec3::Zero());
  const Vec3 stretch(1.3, 0.9, 0.9);
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const auto fields = fields_of(model, mapped(model, turn * stretch.asDiagonal()), {"von_mises", "J"});
  const Vec3 stress = neo_hookean_stress(stretch);
  const double expected = std::abs(stress[0] - stress[1]);
  ASSERT_EQ(fields.size(), 2u);
  EXPECT_STREQ(fields[0].info.unit, "Pa");
  for (const auto* values : {&fields[0].elements, &fields[0].vertices}) {
    for (const double value : *values) EXPECT_NEAR(value, expected, 1e-9 * expected);
  }
  for (const auto* values : {&fields[1].elements, &fields[1].vertices}) {
    for (const double value : *values) EXPECT_NEAR(value, stretch.prod(), 1e-13);
  }
}

TEST(Fields, EnergyDensityAddsUpToTheEnergyOfEachBody) {
  BodyInput soft = cube_body(2), other = cube_body(1, "stable_neo_hookean");
  other.settings.translate = Vec3(4, 0, 0);
  const Model model({soft, other}, Vec3::Zero());
  VecX q = model.initial_state().q;
  for (Eigen::Index i = 0; i < q.size(); ++i) q(i) += 0.03 * std::sin(static_cast<double>(7 * i));
  const auto fields = fields_of(model, q, {"energy_density", "body"});
  double sum = 0, value = 0;
  for (std::size_t j = 0; j < model.mesh().tets.size(); ++j) {
    TetCorners X;
    for (int a = 0; a < 4; ++a) X.col(a) = model.mesh().X.row(model.mesh().tets[j][a]).transpose();
    sum += std::abs(tet_volume(X)) * fields[0].elements[j];
    EXPECT_EQ(fields[1].elements[j], j < 48 ? 0 : 1);
  }
  for (const auto& term : model.energies()) value += term->value(q);
  EXPECT_NEAR(sum, value, 1e-12 * value);
}

/// As they behave: the lecture's young 1e5 and poisson 0.3 are 94406 and 0.227 (tests/data/truth,
/// 6_analytic).
TEST(Fields, TellTheMaterialAtRest) {
  const auto values = [](const std::string& model, const auto& change) {
    BodyInput body = cube_body(1, model);
    body.settings.material = {};
    body.settings.material.model = model;
    body.settings.material.young = 1e5;
    body.settings.material.poisson = 0.3;
    change(body.settings);
    const Model of({body}, Vec3::Zero());
    std::vector<double> all;
    for (const Field& field : fields_of(of, of.initial_state().q, {"young", "poisson", "density"})) {
      for (const double value : field.elements)
        EXPECT_NEAR(value, field.elements[0], 1e-12 * field.elements[0]);
      all.push_back(field.elements[0]);
    }
    return all;
  };
  const auto as_it_is = [](BodySettings& s) { s.density = 900.0; };
  for (const std::string& model : material_names()) {
    if (model == "neo_hookean" || model == "arap" || model == "stress_strain") continue;
    const std::vector<double> got = values(model, as_it_is);
    EXPECT_NEAR(got[0], 1e5, 1e-7) << model;
    EXPECT_NEAR(got[1], 0.3, 1e-12) << model;
    EXPECT_EQ(got[2], 900.0);
  }
  const double mu = 1e5 / 2.6, K = 1e5 * 0.3 / (1.3 * 0.4);
  EXPECT_NEAR(values("neo_hookean", as_it_is)[0], 9 * K * mu / (3 * K + mu), 1e-7);
  EXPECT_NEAR(values("neo_hookean", as_it_is)[1], (3 * K - 2 * mu) / (2 * (3 * K + mu)), 1e-12);
  EXPECT_NEAR(values("arap", as_it_is)[0], 2 * mu, 1e-7);
  // Fibres add their stiffness to both sums.
  const std::vector<double> with_fibres = values("linear", [](BodySettings& s) {
    s.material.fibre =
        FibreSettings{.direction = Vec3(1, 2, 3), .stiffness = 3e4, .exponent = 0.0, .compression = true};
  });
  const double lambda = 1e5 * 0.3 / (1.3 * 0.4);
  const double C_iijj = 9 * lambda + 6 * mu + 3e4, C_ijij = 3 * lambda + 12 * mu + 3e4;
  const double bulk = C_iijj / 9, shear = (C_ijij - C_iijj / 3) / 10;
  EXPECT_NEAR(with_fibres[0], 9 * bulk * shear / (3 * bulk + shear), 1e-7);
}

TEST(Fields, VerticesHaveMeansByVolume) {
  const Model model({cube_body(1)}, Vec3::Zero());
  VecX q = model.initial_state().q;
  q(0) += 0.2, q(7) -= 0.1;
  const Field J = fields_of(model, q, {"J"}).at(0);
  for (int v = 0; v < model.mesh().vertex_count(); ++v) {
    double sum = 0, volume = 0;
    for (std::size_t j = 0; j < model.mesh().tets.size(); ++j) {
      TetCorners X;
      bool has = false;
      for (int a = 0; a < 4; ++a) {
        X.col(a) = model.mesh().X.row(model.mesh().tets[j][a]).transpose();
        has = has || model.mesh().tets[j][a] == v;
      }
      if (has) sum += tet_volume(X) * J.elements[j], volume += tet_volume(X);
    }
    EXPECT_NEAR(J.vertices[static_cast<std::size_t>(v)], sum / volume, 1e-13);
  }
}

/// A body of quadratic tets of no two shapes whose nodes are moved by u(X).
struct QuadraticCube {
  template <typename U>
  explicit QuadraticCube(const U& u) : model({body()}, Vec3::Zero()), q(model.initial_state().q) {
    for (Eigen::Index v = 0; v < model.mesh().vertex_count(); ++v)
      q.segment<3>(3 * v) += u(Vec3(model.mesh().X.row(v).transpose()));
  }
  static BodyInput body() {
    BodyInput body = cube_body(1, "linear");
    body.mesh = with_quadratic_tets(irregular_cube_mesh(3));
    return body;
  }
  Model model;
  VecX q;
};

/// The patch test of quadratic tets: a motion that they hold exactly has its own fields at every vertex.
TEST(Fields, OfAQuadraticMotionAreExactAtTheVerticesOfQuadraticTets) {
  const Vec3 a(0.1, -0.2, 0.05), b(0.3, 0.1, -0.2), c(-0.1, 0.2, 0.1);
  const auto u = [&](const Vec3& X) {
    return Vec3(a * X.x() * X.x() + b * X.y() * X.z() + c * X.z() * (X.z() - X.x()));
  };
  const QuadraticCube cube(u);
  const auto fields = fields_of(cube.model, cube.q, {"J", "energy_density"});
  for (Eigen::Index v = 0; v < cube.model.mesh().vertex_count(); ++v) {
    const Vec3 X = cube.model.mesh().X.row(v);
    Mat3 F = Mat3::Identity();
    F.col(0) += 2 * X.x() * a - X.z() * c;
    F.col(1) += X.z() * b;
    F.col(2) += X.y() * b + (2 * X.z() - X.x()) * c;
    const Mat3 strain = 0.5 * (F + F.transpose()) - Mat3::Identity();
    const double psi =
        kMu * strain.squaredNorm() + kLambda / 2 * strain.trace() * strain.trace();  // ψ of `linear`
    EXPECT_NEAR(fields[0].vertices[static_cast<std::size_t>(v)], F.determinant(), 1e-13);
    EXPECT_NEAR(fields[1].vertices[static_cast<std::size_t>(v)], psi, 1e-12 * kMu);
  }
}

/// Torsion of a round bar: u = θ x (0, -z, y) about the x axis, σ_xy and σ_xz = mu θ (-z, y). The mean of the
/// elements would be wrong by half an element.
TEST(Fields, OfATwistedBarAreItsClosedForm) {
  const double twist = 1e-7;  // [1/m], small: σ is that of the linear theory
  const QuadraticCube cube([&](const Vec3& X) { return Vec3(twist * X.x() * Vec3(0, -X.z(), X.y())); });
  const Field stress = fields_of(cube.model, cube.q, {"von_mises"}).at(0);
  const double most = std::sqrt(6.0) * kMu * twist;
  for (Eigen::Index v = 0; v < cube.model.mesh().vertex_count(); ++v) {
    const double r = cube.model.mesh().X.row(v).tail<2>().norm();
    EXPECT_NEAR(stress.vertices[static_cast<std::size_t>(v)], std::sqrt(3.0) * kMu * twist * r, 1e-6 * most);
  }
}

TEST(Fields, VonMisesOfAVertexIsThatOfTheMeanStress) {
  const BodyInput body = cube_body(2);
  const Model model({body}, Vec3::Zero());
  VecX q = model.initial_state().q;
  for (Eigen::Index i = 0; i < q.size(); ++i) q(i) += 0.03 * std::sin(static_cast<double>(7 * i));
  const auto material = make_material_point(body.settings.material, "");
  const TetMesh& mesh = model.mesh();
  std::vector<Mat3> sums(static_cast<std::size_t>(mesh.vertex_count()), Mat3::Zero());
  std::vector<double> counts(sums.size());  // all tets have the same volume
  for (const Tet& tet : mesh.tets) {
    TetCorners X;
    for (int a = 0; a < 4; ++a) X.col(a) = mesh.X.row(tet[a]).transpose();
    const Mat3 F = deformation_gradient(gather_corners(q, tet), dphi_dX(X));
    for (const int v : tet) {
      sums[static_cast<std::size_t>(v)] += cauchy_stress(material->dpsi_dF(F), F);
      counts[static_cast<std::size_t>(v)] += 1;
    }
  }
  const Field stress = fields_of(model, q, {"von_mises"}).at(0);
  for (std::size_t v = 0; v < sums.size(); ++v)
    EXPECT_NEAR(stress.vertices[v], von_mises(sums[v] / counts[v]), 1e-9 * kMu);
}

TEST(Fields, DisplacementIsTheDistanceFromRest) {
  const Model model({cube_body(1)}, Vec3::Zero());
  VecX q = model.initial_state().q;
  for (Eigen::Index v = 0; v < q.size() / 3; ++v) q.segment<3>(3 * v) += Vec3(3, 0, 4);
  const Field field = fields_of(model, q, {"displacement"}).at(0);
  for (const double d : field.vertices) EXPECT_NEAR(d, 5, 1e-13);
  for (const double d : field.elements) EXPECT_NEAR(d, 5, 1e-13);
}

TEST(Fields, RefuseANameThatIsNone) {
  EXPECT_EQ(error_of([] { find_field("von_mise"); }),
            "unknown field 'von_mise'; valid ones are von_mises, J, energy_density, displacement, young, "
            "poisson, density, body");
}

TEST(Fields, AreWrittenBesideAMeshThatReadsBack) {
  const Model model({cube_body(1)}, Vec3::Zero());
  const auto fields = fields_of(model, model.initial_state().q, {"J", "displacement"});
  const TempFolder folder;
  const auto file = folder.write("state.vtu", io::write_vtu(model.mesh(), fields));
  Remarks remarks;
  const TetMesh back = read_tet_mesh(file, remarks);
  EXPECT_EQ(back.tets, model.mesh().tets);
  EXPECT_EQ(back.X, model.mesh().X);
  const TriMesh surface{model.mesh().X, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
  const std::string ply = io::write_ply(surface, fields);
  EXPECT_NE(ply.find("property double z\nproperty double J\nproperty double displacement\n"),
            std::string::npos);
}

}  // namespace fields_test
}  // namespace lagomorph::sim
