#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/npy.h"
#include "tests/support/truth.h"
#include "tests/unit/apps/pipeline/run_fixture.h"

namespace lagomorph::tests {
namespace static_run_test {

class StaticRun : public ProgramRun {
protected:
  /// The truth's bar, held at X = 0.
  std::string truth_scene(const std::string& material, const std::string& more = "") const {
    dir_.write("bar.toml",
               "[time]\ngravity = [0, -9.81, 0]\n" + more +
                   "[solver]\ntolerance = 1e-10\n[[body]]\nmesh = '" + sim::truth::path("bar.mesh").string() +
                   "'\nmaterial = { model = '" + material +
                   "', young = 1e6, poisson = 0.3 }\n[[body.pin]]\nbox = [[0, -1, -1], [0, 1, 1]]\n");
    return at("bar.toml").string();
  }
  std::vector<double> state(const std::string& run, int frame) const {
    const std::string name = "frame_000" + std::to_string(frame) + ".npy";
    return apps::read_npy(read_all(at(run) / "states" / name), name).values;
  }
  std::vector<std::string> lines(const std::string& file) const {
    std::vector<std::string> all;
    std::istringstream in(read_all(at(file)));
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
  }
};

/// The states on disk: at rest, and the reference's equilibrium.
TEST_F(StaticRun, LeavesRestAndEquilibrium) {
  for (const auto& [material, file] : {std::pair("neo_hookean", "cantilever__nh_lecture"),
                                       std::pair("stable_neo_hookean", "cantilever__snh")}) {
    const std::string run = file;
    expect(0, {"simulate", truth_scene(material), "--static", "--quiet", "-o", at(run).string()});
    const auto rows = sim::truth::csv(std::string("3_bar_static/") + file + ".csv");
    const auto rest = state(run, 0), end = state(run, 1);
    ASSERT_EQ(end.size(), 6 * rows.size());
    double worst_rest = 0.0, worst = 0.0, fastest = 0.0;
    for (std::size_t v = 0; v < rows.size(); ++v) {
      for (std::size_t k = 0; k < 3; ++k) {
        worst_rest = std::max(worst_rest, std::abs(rest[3 * v + k] - rows[v][1 + k]));
        worst = std::max(worst, std::abs(end[3 * v + k] - rows[v][4 + k]));
        fastest = std::max(fastest, std::abs(end[3 * (rows.size() + v) + k]));
      }
    }
    EXPECT_EQ(worst_rest, 0.0);
    EXPECT_LT(worst, 1e-8);
    EXPECT_EQ(fastest, 0.0);
    const auto energy = lines(run + "/energy.csv");
    ASSERT_EQ(energy.size(), 3U);
    EXPECT_FALSE(std::filesystem::exists(at(run) / "states/frame_0002.npy"));
    const auto expected = sim::truth::json("3_bar_static/summary.json")["cases"][file];
    double frame = 0, time = 0, kinetic = 0, elastic = 0;
    char comma = 0;
    std::istringstream(energy[2]) >> frame >> comma >> time >> comma >> kinetic >> comma >> elastic;
    EXPECT_EQ(time, 1 / 30.0);
    EXPECT_EQ(kinetic, 0.0);
    EXPECT_NEAR(elastic, expected["elastic_energy"], 1e-9 * elastic);
  }
}

/// A static run is not a dynamic one, and RUN/scene.toml repeats it.
TEST_F(StaticRun, IsARunOfItsOwn) {
  expect(0, simulate("r", {"--static"}));
  const auto before = tree(at("r"));
  EXPECT_NE(expect(2, simulate("r")).find("time.integrator \"static\" -> default"), std::string::npos);
  expect(0, {"simulate", (at("r") / "scene.toml").string(), "--quiet", "-o", at("again").string()});
  for (const char* file : {"states/frame_0000.npy", "states/frame_0001.npy", "scene.toml"})
    EXPECT_EQ(read_all(at("again") / file), before.at(file)) << file;
  std::filesystem::remove(at("r") / "records/frame_0001.json");
  expect(0, simulate("r", {"--static"}));
  EXPECT_EQ(read_all(at("r") / "states/frame_0001.npy"), before.at("states/frame_0001.npy"));
}

TEST_F(StaticRun, HasTwoFramesWhereTheSceneDoesNotSay) {
  expect(0, {"simulate", truth_scene("stable_neo_hookean", "integrator = 'static'\n"), "--quiet", "-o",
             at("r").string()});
  EXPECT_EQ(lines("r/energy.csv").size(), 3U);
}

TEST_F(StaticRun, EndsWithStatusThreeWhereThereIsNone) {
  dir_.write("free.toml",
             "[solver]\nmax_halvings = 2\n[[body]]\nmesh = '" + data_file("run/bar.msh").string() + "'\n");
  const std::string said =
      expect(3, {"simulate", at("free.toml").string(), "--static", "--quiet", "-o", at("r").string()});
  EXPECT_NE(said.find("frame 1: no equilibrium: a load step of 0.00833333 s"), std::string::npos) << said;
  EXPECT_TRUE(std::filesystem::exists(at("r") / "states/frame_0000.npy"));
  EXPECT_FALSE(std::filesystem::exists(at("r") / "states/frame_0001.npy"));
}

/// The logged run shows Newton's method square its residual.
TEST_F(StaticRun, LogsNewtonsIterations) {
  expect(0, {"simulate", truth_scene("stable_neo_hookean"), "--static", "--log-newton", "--quiet", "-o",
             at("r").string()});
  const auto rows = lines("r/newton.csv");
  ASSERT_GT(rows.size(), 3U);
  EXPECT_EQ(rows[0], "frame,time,h,status,iteration,residual,energy,step,clamping");
  std::vector<double> residuals;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    std::vector<std::string> fields;
    std::istringstream in(rows[i]);
    for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
    ASSERT_EQ(fields.size(), 9U);
    EXPECT_EQ(fields[4], std::to_string(i - 1));
    residuals.push_back(std::stod(fields[5]));
  }
  int squared = 0;
  for (std::size_t k = 1; k < residuals.size(); ++k)
    if (residuals[k - 1] < 0.1 && residuals[k] < residuals[k - 1] * residuals[k - 1] * 10.0) ++squared;
  EXPECT_GE(squared, 2);
  // The log changes nothing else, and is kept by who does not ask for it.
  expect(0, {"simulate", truth_scene("stable_neo_hookean"), "--static", "--quiet", "-o", at("r").string()});
  EXPECT_EQ(lines("r/newton.csv"), rows);
  expect(0,
         {"simulate", truth_scene("stable_neo_hookean"), "--static", "--quiet", "-o", at("plain").string()});
  EXPECT_FALSE(std::filesystem::exists(at("plain") / "newton.csv"));
  for (const char* file : {"energy.csv", "states/frame_0001.npy"})
    EXPECT_EQ(read_all(at("plain") / file), read_all(at("r") / file));
}

/// Damping and adaptive steps of BDF2, cut into parts: the same bytes of states and energies, whose column of
/// losses sums what the records hold.
TEST_F(StaticRun, DampedAdaptiveStepsAreResumedToTheSameBytes) {
  const Arguments how = {"--set", "time.integrator=bdf2",
                         "--set", "time.error_tolerance=1e-3",
                         "--set", "body.0.damping={mass=0.1, stiffness=0.001, viscosity=10}"};
  expect(0, simulate("whole", how));
  expect(0, simulate("parts", how + Arguments{"--frames", "0..1"}));
  expect(0, simulate("parts", how + Arguments{"--frames", "0..2"}));
  expect(0, simulate("parts", how));
  for (int k = 0; k < 4; ++k) EXPECT_EQ(state("parts", k), state("whole", k));
  EXPECT_EQ(lines("parts/energy.csv"), lines("whole/energy.csv"));
  const auto header = lines("whole/energy.csv")[0], last = lines("whole/energy.csv").back();
  EXPECT_NE(header.find(",steps,rejected,damping_loss"), std::string::npos);
  double lost = 0.0;
  const nlohmann::json whole = run_json("whole");
  for (const auto& frame : whole.at("frames")) {
    lost += frame.at("damping_loss").get<double>();
    if (frame.at("frame") == 0) continue;
    EXPECT_GT(frame.at("damping_loss").get<double>(), 0.0);
    EXPECT_GT(frame.at("error").get<double>(), 0.0);
    EXPECT_LE(frame.at("error").get<double>(), 1e-3);
    EXPECT_EQ(frame.at("history_times").size(), 1U);
  }
  EXPECT_NEAR(std::stod(last.substr(last.rfind(',') + 1)), lost, 1e-15 + 1e-12 * lost);
}

TEST_F(StaticRun, ScrambledBodyFindsHome) {
  expect(0, simulate("r", {"--static", "--set", "body.0.start=scramble", "--set", "time.gravity=[0, 0, 0]",
                           "--set", "solver.max_iterations=1000"}));
  expect(0, simulate("rest", {"--frames", "0"}));
  const auto start = state("r", 0), end = state("r", 1), rest = state("rest", 0);
  double before = 0.0, after = 0.0;
  for (std::size_t i = 0; i < rest.size() / 2; ++i) {
    before = std::max(before, std::abs(start[i] - rest[i]));
    after = std::max(after, std::abs(end[i] - rest[i]));
  }
  EXPECT_GT(before, 0.05);
  EXPECT_LT(after, 1e-6);
}

}  // namespace static_run_test
}  // namespace lagomorph::tests
