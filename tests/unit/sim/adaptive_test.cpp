#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/sim/mesh_fixtures.h"
#include "tests/unit/sim/motion.h"

namespace lagomorph::sim {
namespace adaptive_test {

class EachAdaptive : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Integrators, EachAdaptive, testing::ValuesIn(dynamic_integrators()),
                         [](const auto& info) { return info.param; });

/// The reference cube, to t = 0.5 in 5 frames, with its exact end.
struct Adaptive : Motion {
  Adaptive(const std::string& name, std::optional<double> tolerance)
      : Motion(reference_cube("snh"), name, 10.0, 1e-10) {
    for (const auto& row : truth::csv("4b_cube_order/v0.csv"))
      state.qdot.segment<3>(3 * static_cast<int>(row[0])) = Vec3(row[1], row[2], row[3]);
    time.error_tolerance = tolerance;
    solver.max_halvings = 16;
  }
  double error() const {
    double worst = 0.0;
    for (const auto& row : truth::csv("4b_cube_order/exact_t0.5_snh.csv"))
      worst = std::max(
          worst, (state.q.segment<3>(3 * static_cast<int>(row[0])) - Vec3(row[1], row[2], row[3])).norm());
    return worst;
  }
};

/// A tighter tolerance takes more steps and comes nearer to the exact motion; every frame is hit.
TEST_P(EachAdaptive, TakesStepsThatAreAccurateEnough) {
  const bool first = GetParam() == "backward_euler" || GetParam() == "linearly_implicit_euler" ||
                     GetParam() == "symplectic_euler";
  std::vector<double> errors;
  std::vector<int> steps;
  for (const double tolerance : {1e-3, first ? 1e-4 : 1e-5}) {
    Adaptive run(GetParam(), tolerance);
    int taken = 0, rejected = 0;
    for (int k = 1; k <= 5; ++k) {
      const FrameReport report = run.advance();
      ASSERT_TRUE(is_good(report.status)) << report.reason;
      EXPECT_LE(report.error, tolerance);
      EXPECT_EQ(run.state.t, k / 10.0);
      taken += report.steps;
      rejected += report.rejected;
    }
    errors.push_back(run.error());
    steps.push_back(taken);
    EXPECT_GT(rejected, 0);
  }
  EXPECT_GT(steps[1], steps[0]);
  EXPECT_LT(errors[1], 0.6 * errors[0]) << errors[0] << " " << errors[1];
}

/// The estimate is that of the true local error of one step, whose order is one more than the scheme's.
TEST_P(EachAdaptive, EstimatesTheErrorOfAStep) {
  if (GetParam() == "symplectic_euler" || GetParam() == "bdf2") return;  // of many; of more than one step
  Adaptive one(GetParam(), 1.0);
  one.time.fps = 400.0;
  const FrameReport report = one.advance();
  ASSERT_TRUE(is_good(report.status)) << report.reason;
  Adaptive exact("implicit_midpoint", std::nullopt);
  exact.time.fps = 400.0;
  exact.time.substeps = 200;
  exact.advance(1);
  const double true_error =
      std::sqrt(as_points(one.state.q - exact.state.q).rowwise().squaredNorm().maxCoeff());
  EXPECT_GT(report.error, 0.6 * true_error);
  EXPECT_LT(report.error, 1.7 * true_error);
}

/// Steps are as many as they have to be: half as long where it is asked for a quarter of a second-order
/// error.
TEST(AdvanceFrame, KeepsStepsThatAreAccurateEnough) {
  Adaptive loose("backward_euler", 1.0);
  const FrameReport report = loose.advance();
  EXPECT_EQ(report.steps, 1);
  EXPECT_EQ(report.rejected, 0);
  Adaptive none("backward_euler", std::nullopt);
  none.advance(1);
  EXPECT_EQ(loose.state.q, none.state.q);
}

/// Equal neighbours keep the history of BDF2: it starts anew once, not at every step.
TEST(Bdf2, KeepsItsHistoryThroughAdaptiveSteps) {
  Adaptive run("bdf2", 1e-4);
  run.advance(3);
  const FrameReport report = run.advance();
  ASSERT_GT(report.halvings, 0);
  ASSERT_EQ(run.state.history.size(), 1U);
  const double h = run.state.t - run.state.history.front().t;
  EXPECT_LT(h, 0.05);
  EXPECT_GT(h, 0.0);
}

/// History and its time are all that adaptive steps need: a new integrator goes on to the same bytes.
TEST_P(EachAdaptive, GoesOnFromAStateToTheSameBytes) {
  Adaptive whole(GetParam(), 1e-3);
  whole.advance(2);
  Adaptive resumed(GetParam(), 1e-3);
  resumed.state = whole.state;
  whole.advance(2);
  resumed.advance(2);
  EXPECT_EQ(resumed.state.q, whole.state.q);
  EXPECT_EQ(resumed.state.qdot, whole.state.qdot);
}

TEST(AdvanceFrame, EndsWhereNoStepIsAccurateEnough) {
  Adaptive run("backward_euler", 1e-12);
  run.solver.max_halvings = 3;
  const State before = run.state;
  const FrameReport report = run.advance();
  EXPECT_EQ(report.status, StepStatus::inaccurate);
  EXPECT_TRUE(report.reason.starts_with("frame 1: a step of 0.0125 s at t = 0 s was too inaccurate after "))
      << report.reason;
  EXPECT_TRUE(report.reason.ends_with(" m (tolerance 1e-12), halved 3 times")) << report.reason;
  EXPECT_EQ(run.state.q, before.q);
  EXPECT_EQ(run.state.t, 0.0);
}

TEST(MakeIntegrator, TellsAWrongErrorTolerance) {
  TimeSettings time;
  time.error_tolerance = -1.0;
  const Model model = reference_cube("snh");
  EXPECT_EQ(error_of([&] { make_integrator(time, {}, model); }), "time.error_tolerance = -1 must be > 0 m");
}

}  // namespace adaptive_test
}  // namespace lagomorph::sim
