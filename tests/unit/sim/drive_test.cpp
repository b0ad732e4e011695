#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "sim/integrator.h"
#include "tests/support/truth.h"
#include "tests/unit/sim/mesh_fixtures.h"

/// Pins that move and let go, loads that change: in each scheme, by what its own discrete balance says.
namespace lagomorph::sim {
namespace drive_test {

struct Motion {
  Model model;
  TimeSettings time;
  SolverSettings solver;
  std::unique_ptr<Integrator> integrator;
  State state;

  Motion(Model m, const std::string& name, double fps) : model(std::move(m)) {
    time.integrator = name;
    time.fps = fps;
    solver.tolerance = 1e-11;
    integrator = make_integrator(time, solver, model);
    state = model.initial_state();
  }
  FrameReport advance() {
    FrameReport report = advance_frame(model, *integrator, time, solver, state);
    EXPECT_TRUE(is_good(report.status)) << report.reason;
    return report;
  }
};

PinSettings bottom() {
  PinSettings pin;
  pin.bottom = 1e-3;
  return pin;
}
PinSettings top() {
  PinSettings pin;
  pin.top = 1e-3;
  return pin;
}
PinSettings moved(PinSettings pin, std::vector<PinKey> keys, const std::string& interpolation = "smooth") {
  pin.key = std::move(keys);
  pin.interpolation = interpolation;
  return pin;
}

BodyInput cube(const std::string& material = "stable_neo_hookean", int n = 2) {
  BodyInput body{cube_mesh(n), {}};
  body.settings.material.model = material;
  body.settings.material.young = 1e5;
  return body;
}

class EachScheme : public testing::TestWithParam<std::string> {};
/// Those that move in time.
std::vector<std::string> schemes() {
  std::vector<std::string> names = integrator_names();
  std::erase(names, "static");
  return names;
}
INSTANTIATE_TEST_SUITE_P(Integrators, EachScheme, testing::ValuesIn(schemes()),
                         [](const auto& info) { return info.param; });

/// Driven at the body's own velocity: it moves rigidly, and the pins have nothing to do.
TEST_P(EachScheme, LetsABodyMoveOnWithItsPins) {
  BodyInput body = cube();
  const Vec3 v(0.3, -0.2, 0.1);
  body.settings.velocity = v;
  body.settings.pin = {moved(bottom(), {{.time = 10.0, .translate = 10.0 * v}}, "linear")};
  Motion run(Model({body}, Vec3::Zero()), GetParam(), 50);
  for (int frame = 1; frame <= 30; ++frame) {
    const FrameReport report = run.advance();
    const VecX expected = run.model.initial_state().q + run.state.t * v.replicate(27, 1);
    ASSERT_LT((run.state.q - expected).cwiseAbs().maxCoeff(), 1e-12);
    ASSERT_LT((run.state.qdot - v.replicate(27, 1)).cwiseAbs().maxCoeff(), 1e-9);
    ASSERT_LT(report.pin_forces.at(0).norm(), 1e-4);  // of a stiffness of 1e5 N/m and steps of 4e-4 s
    ASSERT_EQ(report.halvings, 0);
  }
}

/// On rails along x and held in y and z it slides; the rails carry its weight.
TEST_P(EachScheme, LetsGoOfTheAxesThatAPinDoesNotHold) {
  BodyInput body = cube();
  body.settings.velocity = Vec3(0.5, 0, 0);
  body.settings.pin = {bottom()};
  body.settings.pin[0].axes = {"y", "z"};
  body.settings.material.young = 1e7;
  Motion run(Model({body}, Vec3(0, -9.81, 0)), GetParam(), 100);
  const VecX rest = run.model.initial_state().q;
  EXPECT_EQ(run.model.pins().free_dofs(), 81 - 18);
  FrameReport report;
  for (int frame = 1; frame <= 20; ++frame) report = run.advance();
  double slid = 0.0;
  for (int v = 0; v < 27; ++v) {
    slid += (run.state.q[3 * v] - rest[3 * v]) / 27.0;
    if (!run.model.pins().is_held(3 * v + 1)) continue;
    EXPECT_EQ(run.state.q[3 * v + 1], rest[3 * v + 1]);
    EXPECT_EQ(run.state.q[3 * v + 2], rest[3 * v + 2]);
  }
  EXPECT_NEAR(slid, 0.1, 1e-4);
  EXPECT_NEAR(run.model.momentum(run.state).x(), 500.0, 1e-5);
  EXPECT_EQ(report.pin_forces.at(0).x(), 0.0);
}

/// A body that everything acts on: a pin that turns and shifts, one that holds, loads with curves, a spring.
BodyInput busy_cube() {
  BodyInput body = cube();
  body.settings.pin = {bottom(),
                       moved(top(), {{.time = 0.3, .translate = {0.1, 0.1, 0}, .rotate = {0, 50, 0}},
                                     {.time = 0.7, .translate = {0, -0.1, 0.1}, .scale = 0.8}})};
  body.settings.pin[0].axes = {"x", "y"};
  LoadSettings push;
  push.plane = PlaneSelector{Vec3(1, 0, 0), Vec3(1, 0, 0)};
  push.traction = Vec3(-300, 0, 500);
  push.curve = {{0, 0}, {0.2, 1}, {0.5, -1}};
  body.settings.load = {push};
  SpringSettings spring;
  spring.vertices = {13};
  spring.stiffness = 200.0;
  spring.to = Vec3(0.5, 3, 0.5);
  spring.rest_length = 2.0;
  body.settings.spring = {spring};
  return body;
}

Vec3 total(const VecX& f) { return as_points(f).colwise().sum().transpose(); }

/// p1 - p0 = h (pins + weight + loads + springs), exactly, with each where the scheme takes it.
TEST_P(EachScheme, ReportsTheForcesOfThePinsOfItsOwnBalance) {
  const std::string& name = GetParam();
  if (name == "symplectic_euler") GTEST_SKIP() << "of its last division; the next test holds it";
  BodyInput body = busy_cube();
  body.settings.spring.clear();
  Motion run(Model({body}, Vec3(0, -9.81, 0)), name, 100);
  const double h = 0.01;
  for (int frame = 1; frame <= 60; ++frame) {
    const Vec3 before = run.model.momentum(run.state);
    const double t = run.state.t;
    const FrameReport report = run.advance();
    ASSERT_EQ(report.halvings, 0);
    if (name == "bdf2" && frame > 1) continue;  // its rate is not this difference
    const VecX load = name == "implicit_midpoint" ? run.model.load_force(t + h / 2)
                      : name == "trapezoidal"
                          ? VecX(0.5 * (run.model.load_force(t) + run.model.load_force(t + h)))
                          : run.model.load_force(t + h);
    ASSERT_EQ(report.pin_forces.size(), 2u);
    const Vec3 force =
        report.pin_forces[0] + report.pin_forces[1] + total(run.model.gravity_force()) + total(load);
    EXPECT_LT(((run.model.momentum(run.state) - before) / h - force).norm(), 1e-6 * (1.0 + force.norm()))
        << frame;
    EXPECT_EQ(report.pin_forces[0].z(), 0.0);
  }
}

TEST(SymplecticEuler, ReportsTheForcesOfThePinsOfItsOwnBalance) {
  BodyInput body = busy_cube();
  body.settings.spring.clear();
  Motion run(Model({body}, Vec3(0, -9.81, 0)), "symplectic_euler", 2000);
  for (int frame = 1; frame <= 60; ++frame) {
    const Vec3 before = run.model.momentum(run.state);
    const VecX load = run.model.load_force(run.state.t);
    const FrameReport report = run.advance();
    ASSERT_EQ(report.steps, 1);
    const Vec3 force =
        report.pin_forces[0] + report.pin_forces[1] + total(run.model.gravity_force()) + total(load);
    EXPECT_LT(((run.model.momentum(run.state) - before) * 2000 - force).norm(), 1e-6 * (1.0 + force.norm()));
  }
}

/// A free body under a force that grows: its velocity tells when the scheme looks.
TEST_P(EachScheme, TakesLoadsAtItsOwnTime) {
  const std::string& name = GetParam();
  BodyInput body = cube();
  body.settings.load.emplace_back().acceleration = Vec3(2, 0, 0);
  body.settings.load[0].curve = {{0, 0}, {1, 1}};  // a(t) = 2 t
  const double h = 0.001;
  Motion run(Model({body}, Vec3::Zero()), name, 1 / h);
  const FrameReport report = run.advance();
  const double factor = name == "symplectic_euler"                             ? 0.0
                        : name == "implicit_midpoint" || name == "trapezoidal" ? 0.5
                                                                               : 1.0;
  const double v = factor * 2 * h * h;
  EXPECT_NEAR(run.state.qdot[0], v, 1e-12);
  const double dx = run.state.q[0] - run.model.initial_state().q[0];
  EXPECT_NEAR(report.work_loads, 1000.0 * v / h * dx, 1e-12);
  EXPECT_EQ(report.work_pins, 0.0);
}

double energy(const Motion& run) { return run.model.energies_of(run.state).total(); }

/// T + V changes by what pins and loads do, less what backward Euler loses.
TEST(BackwardEuler, BalancesItsEnergyButForALoss) {
  Motion run(Model({busy_cube()}, Vec3(0, -9.81, 0)), "backward_euler", 100);
  double lost = 0.0, worked = 0.0;
  for (int frame = 1; frame <= 100; ++frame) {
    const double before = energy(run);
    const FrameReport report = run.advance();
    const double loss = before + report.work_pins + report.work_loads - energy(run);
    EXPECT_GE(loss, -1e-9) << frame;
    lost += loss;
    worked += std::abs(report.work_pins) + std::abs(report.work_loads);
  }
  EXPECT_GT(lost, 0.0);
  EXPECT_LT(lost, 0.6 * worked);
}

double imbalance(const std::string& name, int steps) {
  Motion run(Model({busy_cube()}, Vec3(0, -9.81, 0)), name, steps);
  const double before = energy(run);
  double work = 0.0;
  for (int frame = 1; frame <= steps; ++frame) {
    const FrameReport report = run.advance();
    work += report.work_pins + report.work_loads;
  }
  return std::abs(energy(run) - before - work);
}

TEST(EnergyBalance, IsMetToTheOrderOfTheScheme) {
  EXPECT_NEAR(imbalance("backward_euler", 1600) / imbalance("backward_euler", 3200), 2.0, 0.2);
  for (const char* name : {"implicit_midpoint", "trapezoidal"}) {
    const double coarse = imbalance(name, 400), fine = imbalance(name, 800);
    EXPECT_LT(coarse, 0.1) << name;  // of some 100 J
    EXPECT_GT(coarse / fine, 3.3) << name;
  }
}

/// Driven and loaded, each scheme keeps the order that it has without.
TEST(Convergence, KeepsItsOrderWhenPinsMove) {
  const auto end = [](const std::string& name, int steps) {
    BodyInput body{truth::mesh("4b_cube_order/cube5.mesh"), {}};
    body.settings.material.young = 1e5;
    const auto swing = [](double t) {
      return PinKey{.time = t, .translate = {0.1 * std::sin(9 * t), 0, 0.1 * std::sin(5 * t)}};
    };
    PinSettings pin = bottom();
    for (int k = 0; k <= 4; ++k) pin.key.push_back(swing(0.125 * k));
    body.settings.pin = {pin};
    body.settings.load.emplace_back().force = Vec3(0, 0, 300);
    body.settings.load[0].curve = {{0, 1}, {0.5, -1}};
    Motion run(Model({body}, Vec3(0, -9.81, 0)), name, 2 * steps);
    for (int k = 0; k < steps; ++k) run.advance();
    return run.state.q;
  };
  const VecX exact = end("implicit_midpoint", 3200);
  const auto order = [&](const std::string& name, int steps) {
    return std::log2((end(name, steps) - exact).norm() / (end(name, 2 * steps) - exact).norm());
  };
  for (const char* first : {"backward_euler", "linearly_implicit_euler"})
    EXPECT_NEAR(order(first, 640), 1.0, 0.1) << first;
  for (const char* second : {"bdf2", "implicit_midpoint", "trapezoidal"})
    EXPECT_NEAR(order(second, 160), 2.0, 0.15) << second;
}

/// Half its height away in one step: the inside is carried along, and no element inverts.
TEST(DrivenPins, CarryALectureNeoHookeanBodyAlongWhenTheyJump) {
  for (const Vec3& jump : {Vec3(0, 0.5, 0), Vec3(0, -0.4, 0), Vec3(0.7, 0, 0), Vec3(3, 0, 0)}) {
    BodyInput body = cube("neo_hookean", 4);
    body.settings.pin = {bottom(), moved(top(), {{.time = 0.0, .translate = jump}})};
    Motion run(Model({body}, Vec3(0, -9.81, 0)), "backward_euler", 30);
    const FrameReport report = run.advance();
    EXPECT_EQ(report.halvings, 0) << jump.transpose();
    EXPECT_LT(report.newton_iterations, 30) << jump.transpose();
    EXPECT_GT(run.model.min_J(run.state.q), 0.0);
    const Vec3 tip = run.state.q.tail<3>();
    EXPECT_EQ(tip, Vec3(Vec3(1, 1, 1) + jump));
  }
}

/// Pulled through its own floor it cannot be carried: the step is halved, and then the run ends.
TEST(DrivenPins, EndTheRunWhereNoStepArrives) {
  BodyInput body = cube("neo_hookean");
  body.settings.pin = {bottom(), moved(top(), {{.time = 0.0, .translate = {0, -2, 0}}})};
  Motion run(Model({body}, Vec3::Zero()), "backward_euler", 30);
  run.solver.max_halvings = 2;
  const State before = run.state;
  const FrameReport report = advance_frame(run.model, *run.integrator, run.time, run.solver, run.state);
  EXPECT_FALSE(is_good(report.status));
  EXPECT_EQ(report.halvings, 2);
  EXPECT_EQ(run.state.q, before.q);
}

/// Thrown: after the release it flies on with the velocity that it had, from a resumed state to the same
/// bits.
TEST_P(EachScheme, LetsGoAtTheReleaseAndKeepsTheVelocity) {
  BodyInput body = cube();
  const Vec3 v(0.3, 0.4, 0.0);
  body.settings.velocity = v;
  body.settings.pin = {moved(bottom(), {{.time = 1.0, .translate = v}}, "linear"), top()};
  body.settings.pin[0].release = 0.1;
  body.settings.pin[1].release = 0.2;
  body.settings.pin[1].key = body.settings.pin[0].key;
  body.settings.pin[1].interpolation = "linear";
  const auto make = [&] { return Motion(Model({body}, Vec3::Zero()), GetParam(), 50); };
  Motion run = make();
  EXPECT_EQ(run.model.held(0.09).pins().free_dofs(), 81 - 54);
  EXPECT_EQ(run.model.held(0.11).pins().free_dofs(), 81 - 27);
  EXPECT_EQ(run.model.held(0.21).pins().free_dofs(), 81);
  for (int frame = 1; frame <= 20; ++frame) {
    const State before = run.state;
    const FrameReport report = run.advance();
    ASSERT_LT((run.model.momentum(run.state) - 1000.0 * v).norm(), 1e-6);
    if (frame > 5) {
      EXPECT_EQ(report.pin_forces[0], Vec3::Zero());
    }
    if (frame > 10) {
      EXPECT_EQ(report.pin_forces[1], Vec3::Zero());
    }
    Motion resumed = make();
    resumed.state = before;
    resumed.advance();
    ASSERT_EQ(resumed.state.q, run.state.q) << frame;
    ASSERT_EQ(resumed.state.qdot, run.state.qdot) << frame;
  }
}

TEST(DrivenPins, MayNotContradictEachOther) {
  BodyInput body = cube();
  body.settings.pin = {bottom(), moved(bottom(), {{.time = 1.0}})};
  EXPECT_EQ(error_of([&] { Model({body}, Vec3::Zero()); }),
            "body 'body0': pin 1 and body 'body0': pin 0 both hold axis x of vertex 0 and one of them moves; "
            "select each vertex once");
  body.settings.pin[0].axes = {"y"};
  body.settings.pin[1].axes = {"x", "z"};
  EXPECT_EQ(error_of([&] { Model({body}, Vec3::Zero()); }), "no error");
  body.settings.pin[0].axes = {"w"};
  EXPECT_EQ(error_of([&] { Model({body}, Vec3::Zero()); }),
            "body 'body0': pin 0: unknown axis 'w'; valid ones are x, y, z");
  body.settings.pin[0].axes = {};
  EXPECT_EQ(error_of([&] { Model({body}, Vec3::Zero()); }),
            "body 'body0': pin 0: axes is empty; give some of x, y, z");
  body.settings.pin[0] = bottom();
  body.settings.pin[0].release = 0.0;
  EXPECT_EQ(error_of([&] { Model({body}, Vec3::Zero()); }), "body 'body0': pin 0: release = 0 must be > 0 s");
}

/// A mass on a spring swings with ω² = k/m.
TEST(Springs, SwingABodyAtItsFrequency) {
  BodyInput body = cube("stable_neo_hookean", 1);
  body.settings.material.young = 1e9;  // rigid beside the springs
  SpringSettings spring;
  spring.plane = PlaneSelector{Vec3::Zero(), Vec3(0, -1, 0)};  // the four of the bottom
  spring.stiffness = 1000.0;
  body.settings.spring = {spring};
  body.settings.velocity = Vec3(0, 0.1, 0);
  Motion run(Model({body}, Vec3::Zero()), "implicit_midpoint", 1000);
  const double omega = std::sqrt(4 * 1000.0 / 1000.0);
  for (int k = 0; k < 600; ++k) run.advance();
  const Vec3 middle = as_points(run.state.q).colwise().mean().transpose();
  EXPECT_NEAR(middle.y() - 0.5, 0.1 / omega * std::sin(omega * 0.6), 1e-5);
}

TEST(Model, StartsWithSpinAboutTheCenterOfMassAndVelocitiesOfAFile) {
  BodyInput a = cube(), b = cube();
  a.settings.translate = Vec3(5, 1, 0);
  a.settings.spin = Vec3(0, 0, 3);
  a.settings.velocity = Vec3(1, 0, 0);
  b.velocities = Points::Random(27, 3);
  const Model model({a, b}, Vec3::Zero());
  const State state = model.initial_state();
  for (int v = 0; v < 27; ++v) {
    const Vec3 x = state.q.segment<3>(3 * v) - Vec3(5.5, 1.5, 0.5);
    EXPECT_LT((Vec3(state.qdot.segment<3>(3 * v)) - Vec3(1 - 3 * x.y(), 3 * x.x(), 0)).norm(), 1e-12);
    EXPECT_EQ(Vec3(state.qdot.segment<3>(81 + 3 * v)), Vec3(b.velocities.row(v).transpose()));
  }
  b.velocities = Points::Random(26, 3);
  EXPECT_EQ(error_of([&] { Model({b}, Vec3::Zero()); }),
            "body 'body0': velocities must be finite and one for each of the 27 vertices");
  // L = m r × v + I ω of a cube of 1 m and 1000 kg: I = 1000/6.
  const Model one({a}, Vec3::Zero());
  const Vec3 L = one.angular_momentum(one.initial_state());
  EXPECT_LT((L - Vec3(0, 500, -1500 + 500)).norm(), 1e-9);
  EXPECT_NEAR(one.min_J(one.initial_state().q), 1.0, 1e-13);
}

}  // namespace drive_test
}  // namespace lagomorph::sim
