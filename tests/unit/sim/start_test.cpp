#include "sim/start.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/support/ledger.h"
#include "tests/unit/sim/mesh_fixtures.h"
#include "tests/unit/sim/motion.h"

namespace lagomorph::sim {
namespace start_test {

Model cube(const std::string& start, bool held, int seed = 0,
           const std::string& model = "stable_neo_hookean") {
  BodyInput body{cube_mesh(3), {}};
  body.settings.start = start;
  body.settings.seed = seed;
  body.settings.material.model = model;
  body.settings.material.young = 1e5;
  body.settings.damping.mass = held ? 0.0 : 5.0;
  if (held) body.settings.pin.emplace_back().top = 0.1;
  return Model({body}, Vec3::Zero());
}

VecX rest_of(const Model& model) { return as_q(model.mesh().X); }

/// The largest distance to the rest shape after the best rigid motion. [Kabsch 1976]
double distance_to_rest(const Model& model, const VecX& q) {
  Points x = as_points(q), X = model.mesh().X;
  x.rowwise() -= x.colwise().mean().eval();
  X.rowwise() -= X.colwise().mean().eval();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(Eigen::MatrixXd(X.transpose() * x),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1);
  const Eigen::Matrix3d R = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  return (x - X * R).rowwise().norm().maxCoeff();
}

TEST(Start, ScramblesWithinTheBox) {
  const Model model = cube("scramble", true);
  const VecX q = model.initial_state().q, X = rest_of(model);
  EXPECT_GE(q.minCoeff(), 0.0);
  EXPECT_LE(q.maxCoeff(), 1.0);
  int moved = 0;
  for (int v = 0; v < model.mesh().vertex_count(); ++v) {
    const double d = (q.segment<3>(3 * v) - X.segment<3>(3 * v)).norm();
    if (model.pins().is_pinned(v)) {
      EXPECT_EQ(d, 0.0);
    } else {
      moved += d > 0.1 ? 1 : 0;
    }
  }
  EXPECT_GT(moved, 40);
  EXPECT_EQ(cube("scramble", true).initial_state().q, q);
  EXPECT_NE(cube("scramble", true, 1).initial_state().q, q);
}

TEST(Start, FlattensToAPlane) {
  const Model model = cube("flatten", false);
  const VecX q = model.initial_state().q;
  for (Eigen::Index i = 1; i < q.size(); i += 3) EXPECT_EQ(q[i], 0.5);
}

TEST(Start, TellsWhatIsWrong) {
  EXPECT_EQ(error_of([] { cube("upside_down", true); }),
            "body 'body0': unknown start 'upside_down'; valid ones are rest, scramble, flatten");
  EXPECT_EQ(error_of([] { cube("scramble", true, 0, "neo_hookean"); }),
            "a body starts with tets inside out, where the material neo_hookean is not defined");
}

struct StartCase {
  const char* start;
  int seed;
  const char* model;
};
class InversionRecovery : public testing::TestWithParam<StartCase> {};
INSTANTIATE_TEST_SUITE_P(StableNeoHookean, InversionRecovery,
                         testing::Values(StartCase{"scramble", 0, "stable_neo_hookean"},
                                         StartCase{"scramble", 1, "stable_neo_hookean"},
                                         StartCase{"flatten", 0, "stable_neo_hookean"},
                                         StartCase{"scramble", 0, "stable_neo_hookean_log"},
                                         StartCase{"flatten", 0, "stable_neo_hookean_log"}),
                         [](const auto& info) {
                           return std::string(info.param.start) + std::to_string(info.param.seed) + "_" +
                                  info.param.model;
                         });

/// Held at its top, the equilibrium that Newton finds from there is the rest shape. [Smith et al. 2018, Sec.
/// 6]
TEST_P(InversionRecovery, FindsHomeInStatics) {
  const StartCase& c = GetParam();
  Motion run(cube(c.start, true, c.seed, c.model), "static", 30.0, 1e-6);
  run.solver.max_iterations = 1000;
  run.integrator = make_integrator(run.time, run.solver, run.model);
  const FrameReport report = run.advance();
  ASSERT_TRUE(is_good(report.status)) << report.reason;
  const double worst = (run.state.q - rest_of(run.model)).cwiseAbs().maxCoeff();
  tell("recovery", {"start", "model", "Newton iterations to rest", "largest distance to it [m]"},
       {c.start, c.model, std::to_string(report.newton_iterations), told(worst)});
  EXPECT_LT(worst, 1e-6) << report.newton_iterations;
}

/// Nothing holds it: damped motion ends in the rest shape, wherever and however turned.
TEST_P(InversionRecovery, FindsHomeInDampedMotion) {
  const StartCase& c = GetParam();
  Motion run(cube(c.start, false, c.seed, c.model), "backward_euler", 30.0, 1e-6);
  EXPECT_GT(distance_to_rest(run.model, run.state.q), 0.3);
  for (int k = 0; k < 150; ++k) {
    const FrameReport report = run.advance();
    ASSERT_TRUE(is_good(report.status)) << report.reason;
  }
  EXPECT_LT(distance_to_rest(run.model, run.state.q), 1e-3);
}

}  // namespace start_test
}  // namespace lagomorph::sim
