#include "sim/model.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "sim/kinematics.h"
#include "tests/support/finite_differences.h"
#include "tests/support/truth.h"
#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace model_test {

const Vec3 kGravity(0, -9.81, 0);

BodyInput cube_body(int n = 2) { return {cube_mesh(n), {}}; }

/// What building a model of one changed cube says.
std::string error_with(const std::function<void(BodySettings&)>& change) {
  BodyInput body = cube_body();
  change(body.settings);
  return error_of([&] { Model({body}, kGravity); });
}

TEST(Model, MergesItsBodiesInOrder) {
  BodyInput a = cube_body(1), b = cube_body(2);
  a.settings.name = "small";
  b.settings.translate = Vec3(5, 0, 0);
  const Model model({a, b}, kGravity);
  const TetMesh& mesh = model.mesh();
  ASSERT_EQ(mesh.bodies.size(), 2u);
  EXPECT_EQ(mesh.bodies[0].name, "small");
  EXPECT_EQ(mesh.bodies[1].name, "body1");
  EXPECT_EQ(mesh.bodies[1].vertices.begin, 8);
  EXPECT_EQ(mesh.bodies[1].vertices.end, 8 + 27);
  EXPECT_EQ(mesh.bodies[1].tets.begin, 6);
  EXPECT_EQ(mesh.bodies[1].tets.end, 6 + 48);
  EXPECT_EQ(mesh.tags.size(), mesh.tets.size());
  for (int k = 0; k < 4; ++k) EXPECT_EQ(mesh.tets[6][k], b.mesh.tets[0][k] + 8);
  EXPECT_EQ(Vec3(mesh.X.row(8)), Vec3(5, 0, 0));
}

TEST(Model, WeighsWhatItsVolumesDo) {
  BodyInput a = cube_body(3), b = cube_body(2);
  a.settings.density = 1234.5;
  b.settings.density = 10.0;
  b.settings.scale = 2.0;
  b.settings.mass = "lumped";
  b.settings.rotate = Vec3(30, 40, 50);
  const Model model({a, b}, kGravity);
  EXPECT_NEAR(model.total_mass(), 1234.5 + 80.0, 1e-12 * 1314.5);
  const SparseMatrix M = model.mass();
  EXPECT_NEAR(M.sum(), 3 * 1314.5, 1e-12 * 3 * 1314.5);
  const VecX v = VecX::LinSpaced(M.rows(), -1, 1);
  EXPECT_LT((model.mass_times(v) - M * v).norm(), 1e-14 * (M * v).norm());
  BlockHessian H(model.pattern());
  model.add_mass(2.0, H);
  EXPECT_LT((H.to_sparse() - 2.0 * M).norm(), 1e-14 * M.norm());
}

TEST(Model, PullsByGravityThroughM) {
  const Model model({cube_body()}, Vec3(1, -2, 3));
  EXPECT_EQ(model.gravity_force(), model.mass_times(Vec3(1, -2, 3).replicate(27, 1)));
  Vec3 weight = as_points(model.gravity_force()).colwise().sum().transpose();
  EXPECT_LT((weight - 1000.0 * Vec3(1, -2, 3)).norm(), 1e-11);
}

TEST(Model, StartsAtRestShapeWithTheSceneVelocityButForPins) {
  BodyInput body = cube_body(1);
  body.settings.velocity = Vec3(1, 2, 3);
  body.settings.pin.emplace_back().vertices = {5};
  const Model model({body}, kGravity);
  const State state = model.initial_state();
  EXPECT_EQ(state.frame, 0);
  EXPECT_EQ(state.t, 0.0);
  EXPECT_TRUE(state.history.empty());
  EXPECT_EQ(as_points(state.q), model.mesh().X);
  for (int v = 0; v < 8; ++v)
    EXPECT_EQ(Vec3(state.qdot.segment<3>(3 * v)), v == 5 ? Vec3(Vec3::Zero()) : Vec3(1, 2, 3));
}

TEST(Model, PinsTheUnionOfItsPinsBodyByBody) {
  BodyInput a = cube_body(1), b = cube_body(1);
  a.settings.pin.emplace_back().vertices = {1};
  a.settings.pin.emplace_back().top = 0.1;
  b.settings.translate = Vec3(0, 10, 0);
  b.settings.pin.emplace_back().bottom = 0.1;
  const Model model({a, b}, kGravity);
  EXPECT_EQ(model.pins().vertices(), (std::vector<int>{1, 2, 3, 6, 7, 8, 9, 12, 13}));
}

TEST(Model, TellsTheEnergiesOfTheReferenceTet) {
  const auto truth = truth::json("2_tet/tet.json");
  const auto& deformed = truth.at("deformed");
  BodyInput body{one_tet(), {}};
  State state;
  state.q.resize(12);
  state.qdot.resize(12);
  for (std::size_t i = 0; i < 12; ++i) {
    body.mesh.X(static_cast<int>(i / 3), static_cast<int>(i % 3)) = truth["X"][i / 3][i % 3];
    state.q[static_cast<int>(i)] = deformed["q"][i];
    state.qdot[static_cast<int>(i)] = deformed["v"][i];
  }
  body.settings.density = truth.at("rho");
  body.settings.material.young = deformed.at("E");
  const Model model({body}, kGravity);
  const Energies energies = model.energies_of(state);
  EXPECT_NEAR(energies.kinetic, deformed.at("kinetic_energy"), 1e-12 * energies.kinetic);
  EXPECT_NEAR(energies.elastic, deformed.at("models").at("snh").at("V"), 1e-12 * energies.elastic);
  EXPECT_NEAR(energies.gravitational, deformed.at("gravity_potential"), 1e-12 * energies.gravitational);
  EXPECT_EQ(energies.total(), energies.kinetic + energies.elastic + energies.gravitational);
  EXPECT_EQ(energies.lagrangian(), energies.kinetic - energies.elastic - energies.gravitational);
  for (std::size_t i = 0; i < 12; ++i)
    EXPECT_NEAR(model.gravity_force()[static_cast<int>(i)],
                deformed.at("gravity_force_consistent")[i].get<double>(), 1e-10);
}

/// The Euler-Lagrange equations of L = T - V: d/dt ∂L/∂q̇ = ∂L/∂q with ∂L/∂q̇ = M q̇ and ∂L/∂q = -∂V/∂q, that
/// is, M q̈ = -∂V/∂q.
TEST(Model, LagrangianHasMomentumAndForceAsDerivatives) {
  BodyInput body = cube_body();
  body.settings.material.young = 1e3;
  const Model model({body}, kGravity);
  State state = model.initial_state();
  const Eigen::Index n = state.q.size();
  for (Eigen::Index i = 0; i < n; ++i) {
    state.q[i] += 0.03 * std::sin(7.0 * static_cast<double>(i));
    state.qdot[i] = std::cos(3.0 * static_cast<double>(i));
  }
  VecX dq(n), f = VecX::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) dq[i] = std::sin(5.0 * static_cast<double>(i));
  for (const auto& term : model.energies()) term->add_gradient(state.q, -1.0, f);
  const auto lagrangian = [&](double along_q, double along_qdot) {
    State moved = state;
    moved.q += along_q * dq;
    moved.qdot += along_qdot * dq;
    return model.energies_of(moved).lagrangian();
  };
  expect_second_order([&](double t) { return lagrangian(0.1 * t, 0.0); }, 0.1 * f.dot(dq));
  expect_second_order([&](double t) { return lagrangian(0.0, t); }, model.mass_times(state.qdot).dot(dq));
}

TEST(Model, SumsMomentum) {
  BodyInput body = cube_body();
  body.settings.velocity = Vec3(1, -2, 3);
  const Model model({body}, kGravity);
  EXPECT_LT((model.momentum(model.initial_state()) - 1000.0 * Vec3(1, -2, 3)).norm(), 1e-10);
}

TEST(Model, MixesMaterials) {
  BodyInput a = cube_body(1), b = cube_body(1), c = cube_body(1);
  a.settings.material.model = c.settings.material.model = "neo_hookean";
  a.settings.material.young = 1e4;
  b.settings.translate = Vec3(3, 0, 0);
  c.settings.translate = Vec3(6, 0, 0);
  const Model all({a, b, c}, kGravity);
  ASSERT_EQ(all.energies().size(), 3u);
  EXPECT_EQ(all.energies()[0]->name(), "neo_hookean");
  EXPECT_EQ(all.energies()[1]->name(), "stable_neo_hookean");
  EXPECT_EQ(all.energies()[2]->name(), "gravity");
  const auto stretched_energy = [](const Model& model) {
    State state = model.initial_state();
    for (Eigen::Index i = 1; i < state.q.size(); i += 3) state.q[i] *= 1.2;
    return model.energies_of(state).elastic;
  };
  EXPECT_NEAR(stretched_energy(all),
              stretched_energy(Model({a}, kGravity)) + stretched_energy(Model({b}, kGravity)) +
                  stretched_energy(Model({c}, kGravity)),
              1e-9);
}

TEST(Model, TellsWhatIsWrong) {
  using S = BodySettings;
  EXPECT_EQ(error_of([] { Model({}, kGravity); }), "there is no body; give at least one");
  EXPECT_EQ(error_of([] { Model({cube_body()}, Vec3(0, NAN, 0)); }), "gravity must be finite");
  EXPECT_EQ(error_of([] { Model({BodyInput{}}, kGravity); }), "body 'body0': its mesh has no tets");
  EXPECT_EQ(error_with([](S& s) { s.density = 0.0; }), "body 'body0': density = 0 must be > 0 kg/m^3");
  EXPECT_EQ(error_with([](S& s) { s.scale = -1.0; }), "body 'body0': scale = -1 must be > 0");
  EXPECT_EQ(error_with([](S& s) { s.scale = 1e-150; }),
            "body 'body0': tet 0 has volume 0 m^3; it must be > 0");
  EXPECT_EQ(error_with([](S& s) { s.velocity[1] = INFINITY; }), "body 'body0': velocity must be finite");
  EXPECT_EQ(error_with([](S& s) { s.mass = "heavy"; }),
            "body 'body0': unknown mass 'heavy'; valid ones are consistent, lumped");
  EXPECT_EQ(error_with([](S& s) { s.name = "bunny", s.material.young = -1.0; }),
            "body 'bunny': material: young = -1 must be > 0 Pa");
  EXPECT_EQ(error_with([](S& s) { s.pin.resize(2), s.pin[0].top = 0.1, s.pin[1].vertices = {99}; }),
            "body 'body0': pin 1: vertex 99 is out of range; the body's vertices are 0 to 26");
  BodyInput twice = cube_body();
  twice.settings.name = "body1";
  EXPECT_EQ(error_of([&] {
              Model({twice, cube_body()}, kGravity);
            }),
            "body 'body1': another body has that name; give each its own");
}

}  // namespace model_test
}  // namespace lagomorph::sim
