#include "sim/statics.h"

#include <gtest/gtest.h>

#include "tests/support/ledger.h"
#include "tests/support/truth.h"

namespace lagomorph::sim {
namespace statics_test {

struct Case {
  const char* name;
  const char* model;
  double young;
  Vec3 gravity;
};

class SaggingBar : public testing::TestWithParam<Case> {};

TEST_P(SaggingBar, MeetsTruth) {
  const Case& c = GetParam();
  const Model model = truth::bar(c.model, c.young, c.gravity);
  SolverSettings settings;
  settings.tolerance = 1e-10;
  State state = model.initial_state();
  const NewtonReport report = static_equilibrium(model, settings, state.q);
  ASSERT_EQ(report.status, StepStatus::converged);

  const auto rows = truth::csv(std::string("3_bar_static/") + c.name + "__" + c.model + ".csv");
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(model.mesh().vertex_count()));
  double worst = 0.0;
  for (std::size_t v = 0; v < rows.size(); ++v)
    for (int k = 0; k < 3; ++k)
      worst = std::max(
          worst, std::abs(rows[v][4 + static_cast<std::size_t>(k)] - state.q[3 * static_cast<int>(v) + k]));
  tell("static", {"bar", "model", "largest error of a position [m]"},
       {c.name, truth::model_name(c.model), told(worst)});
  EXPECT_LT(worst, 1e-8);

  const auto expected =
      truth::json("3_bar_static/summary.json")["cases"][std::string(c.name) + "__" + c.model];
  const Energies energies = model.energies_of(state);
  const double elastic = expected["elastic_energy"], gravitational = expected["gravity_potential"];
  EXPECT_NEAR(energies.elastic, elastic, 1e-9 * elastic);
  EXPECT_NEAR(energies.gravitational, gravitational, 1e-9 * std::abs(gravitational));
  EXPECT_EQ(energies.kinetic, 0.0);

  const std::vector<Vec3> forces = model.held(0.0).forces(report.balance);
  ASSERT_EQ(forces.size(), 1u);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(forces[0][k],
                expected["sum_constraint_force_on_pins"][static_cast<std::size_t>(k)].get<double>(), 1e-7);
}

INSTANTIATE_TEST_SUITE_P(Statics, SaggingBar,
                         testing::Values(Case{"cantilever", "nh_lecture", 1e6, Vec3(0, -9.81, 0)},
                                         Case{"cantilever", "snh", 1e6, Vec3(0, -9.81, 0)},
                                         Case{"cantilever", "snh_log", 1e6, Vec3(0, -9.81, 0)},
                                         Case{"hanging", "nh_lecture", 2e4, Vec3(9.81, 0, 0)},
                                         Case{"hanging", "snh", 2e4, Vec3(9.81, 0, 0)}),
                         [](const auto& info) {
                           return std::string(info.param.name) + "_" + info.param.model;
                         });

}  // namespace statics_test
}  // namespace lagomorph::sim
