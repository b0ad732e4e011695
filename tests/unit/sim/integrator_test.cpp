#include "sim/integrator.h"

#include <gtest/gtest.h>

#include "tests/support/truth.h"

namespace lagomorph::sim {
namespace {

/// Steps the bar 50 times and compares positions with those of the truth at each step.
void expect_bar_positions(const char* model_name, double fps, const std::string& case_name) {
  const Model model = truth::bar(model_name, 1e6, Vec3(0, -9.81, 0));
  TimeSettings time;
  time.fps = fps;
  SolverSettings solver;
  solver.tolerance = 1e-11;
  const auto integrator = make_integrator(time, solver, model);
  const std::vector<double> positions = truth::npy("4_bar_dynamic/" + case_name + "_positions.npy");
  State state = model.initial_state();
  double worst = 0.0;
  for (int frame = 1; frame <= 50; ++frame) {
    const FrameReport report = advance_frame(model, *integrator, time, solver, state);
    ASSERT_TRUE(is_good(report.status)) << report.reason;
    const Eigen::Map<const VecX> expected(positions.data() + frame * state.q.size(), state.q.size());
    worst = std::max(worst, (state.q - expected).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(worst, 1e-8);
}

TEST(BackwardEuler, BarMeetsTruth) { expect_bar_positions("nh_lecture", 60, "be_dt60_nh_lecture"); }
TEST(BackwardEuler, StableBarMeetsTruth) { expect_bar_positions("snh", 60, "be_dt60_snh"); }

}  // namespace
}  // namespace lagomorph::sim
