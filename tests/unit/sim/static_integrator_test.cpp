#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/ledger.h"
#include "tests/support/truth.h"
#include "tests/unit/sim/mesh_fixtures.h"
#include "tests/unit/sim/motion.h"

namespace lagomorph::sim {
namespace static_integrator_test {

double distance(const VecX& a, const VecX& b) { return (a - b).cwiseAbs().maxCoeff(); }

VecX expected_positions(const std::string& name) {
  const auto rows = truth::csv("3_bar_static/" + name + ".csv");
  VecX q(3 * static_cast<Eigen::Index>(rows.size()));
  for (std::size_t v = 0; v < rows.size(); ++v)
    q.segment<3>(3 * static_cast<Eigen::Index>(v)) = Vec3(rows[v][4], rows[v][5], rows[v][6]);
  return q;
}

TEST(Static, FindsTheEquilibriumInOneFrame) {
  Motion run(truth::bar("nh_lecture", 1e6, kGravity), "static", 30.0, 1e-10);
  const FrameReport report = run.advance();
  ASSERT_TRUE(is_good(report.status)) << report.reason;
  EXPECT_EQ(report.steps, 1);
  EXPECT_LT(distance(run.state.q, expected_positions("cantilever__nh_lecture")), 1e-8);
  EXPECT_EQ(run.state.qdot, VecX::Zero(run.state.q.size()));
  EXPECT_EQ(run.state.t, 1 / 30.0);
  const VecX q = run.state.q;
  run.advance(1);  // nothing is left to do
  EXPECT_LT(distance(run.state.q, q), 1e-9);
}

/// Substeps are equal load steps; each is the equilibrium of its part of gravity.
TEST(Static, StepsTheLoad) {
  Motion run(truth::bar("snh", 1e6, kGravity), "static", 30.0, 1e-10);
  State half = run.state;
  ASSERT_TRUE(is_good(run.integrator->step(run.model, half, 0.5 / 30.0).status));
  Motion light(truth::bar("snh", 1e6, 0.5 * kGravity), "static", 30.0, 1e-10);
  light.advance(1);
  EXPECT_LT(distance(half.q, light.state.q), 1e-8);
  run.time.substeps = 5;
  const FrameReport report = run.advance();
  EXPECT_EQ(report.steps, 5);
  EXPECT_LT(distance(run.state.q, expected_positions("cantilever__snh")), 1e-8);
}

/// A soft bar under 30 times its weight: too few iterations for all of it at once, enough for parts.
TEST(Static, HalvesALoadThatIsTooMuchAtOnce) {
  Motion run(truth::bar("nh_lecture", 2e4, Vec3(9.81, 0, 0)), "static", 30.0, 1e-10);
  run.solver.max_iterations = 4;
  run.integrator = make_integrator(run.time, run.solver, run.model);
  const FrameReport report = run.advance();
  ASSERT_TRUE(is_good(report.status)) << report.reason;
  EXPECT_GT(report.halvings, 0);
  EXPECT_GT(report.steps, 1);
  EXPECT_LT(distance(run.state.q, expected_positions("hanging__nh_lecture")), 1e-8);
}

TEST(Static, TellsThatThereIsNone) {
  BodyInput body{cube_mesh(2), {}};  // nothing holds it
  Motion run(Model({body}, kGravity), "static", 30.0, 1e-6);
  run.solver.max_halvings = 3;
  const FrameReport report = run.advance();
  EXPECT_FALSE(is_good(report.status));
  EXPECT_TRUE(report.reason.starts_with(
      "frame 1: no equilibrium: a load step of 0.00416667 s at t = 0 s did not converge after "))
      << report.reason;
  EXPECT_TRUE(report.reason.ends_with("; nothing is pinned")) << report.reason;
  EXPECT_EQ(run.state.q, run.model.initial_state().q);
  EXPECT_EQ(run.state.frame, 0);
}

TEST(Static, StartsAtRest) {
  BodyInput body{cube_mesh(1), {}};
  body.settings.velocity = Vec3(1, 2, 3);
  const Model model({body}, kGravity);
  TimeSettings time;
  time.integrator = "static";
  EXPECT_EQ(make_integrator(time, {}, model)->initial_state(model).qdot, VecX::Zero(24));
}

/// With the exact Hessian each iteration squares the residual, until the rounding of q ends it.
TEST(Newton, ConvergesQuadratically) {
  for (const char* integrator : {"static", "backward_euler", "implicit_midpoint"}) {
    Motion run(reference_cube("snh"), integrator, 4.0, 1e-12);
    const FrameReport report = run.advance();
    ASSERT_TRUE(is_good(report.status)) << report.reason;
    ASSERT_EQ(report.newton.size(), 1U);
    const std::vector<NewtonIterate>& at = report.newton.front().iterates;
    ASSERT_EQ(static_cast<int>(at.size()), report.newton_iterations + 1);
    EXPECT_EQ(at.front().step, 0.0);
    EXPECT_EQ(at.back().residual, report.residual);
    std::string residuals;
    for (const NewtonIterate& i : at) residuals += (residuals.empty() ? "" : ", ") + told(i.residual);
    tell("newton", {"integrator", "residual after each iteration"}, {integrator, residuals});
    int quadratic = 0;
    for (std::size_t k = 1; k < at.size(); ++k) {
      EXPECT_LE(at[k].energy, at[k - 1].energy + 1e-12 * std::abs(at[k - 1].energy));
      if (at[k - 1].residual > 0.1 || at[k].residual < 1e-13) continue;
      EXPECT_EQ(at[k].step, 1.0);
      EXPECT_EQ(at[k].clamping, 0.0);
      EXPECT_LT(at[k].residual, 10.0 * at[k - 1].residual * at[k - 1].residual) << integrator << " " << k;
      ++quadratic;
    }
    EXPECT_GE(quadratic, 2) << integrator;
    if (quadratic < 2)
      for (const NewtonIterate& i : at) ADD_FAILURE() << i.residual << " " << i.step << " " << i.clamping;
  }
}

/// Of a linear material the trapezoidal rule is exact: what pins and loads do is what the springs of its tets
/// keep, in one load step or several.
TEST(Static, WorkIsTheChangeOfElasticEnergy) {
  for (const int substeps : {1, 3}) {
    BodyInput body{cube_mesh(2), {}};
    body.settings.material = {};
    body.settings.material.model = "linear";
    body.settings.pin.emplace_back().box = BoxSelector{Vec3(-9, -9, -9), Vec3(9, 1e-9, 9)};
    PinSettings& top = body.settings.pin.emplace_back();
    top.box = BoxSelector{Vec3(-9, 1.0 - 1e-9, -9), Vec3(9, 9, 9)};
    PinKey& key = top.key.emplace_back();
    key.time = 0.1;
    key.translate = Vec3(0.02, 0.01, 0);
    body.settings.load.emplace_back().body_force = Vec3(300, 0, -200);
    Motion run(Model({body}, Vec3::Zero()), "static", 10.0, 1e-12);
    run.time.substeps = substeps;
    FrameReport report = run.advance();
    ASSERT_TRUE(is_good(report.status)) << report.reason;
    const double elastic = run.model.energies_of(run.state).elastic;
    EXPECT_GT(std::abs(report.work_loads), 0.01 * elastic);
    EXPECT_NEAR(report.work_pins + report.work_loads, elastic, 1e-9 * elastic) << substeps;
  }
}

/// A soft body that nothing holds is at rest where there is no gravity, wherever it is turned inside out
/// from.
TEST(Static, FindsItsWayHomeWithoutPins) {
  BodyInput body{cube_mesh(2), {}};
  body.settings.material.model = "stable_neo_hookean_log";
  body.settings.start = "scramble";
  Motion run(Model({body}, Vec3::Zero()), "static", 10.0, 1e-6);
  const FrameReport report = run.advance();
  ASSERT_TRUE(is_good(report.status)) << report.reason;
  EXPECT_LT(run.model.energies_of(run.state).elastic, 1e-6);
}

}  // namespace static_integrator_test
}  // namespace lagomorph::sim
