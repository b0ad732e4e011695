#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/unit/apps/pipeline/run_fixture.h"

/// Runs whose pictures show a scalar field in colour.
namespace lagomorph::tests {
namespace fields_in_color_test {

namespace fs = std::filesystem;

const Arguments stress = {"--set", "time.frames=6", "--set", "body.0.look.field=von_mises"};

class FieldsInColor : public ProgramRun {
protected:
  void SetUp() override { backend_ = "raster"; }

  nlohmann::json range(const std::string& run, std::size_t frame) const {
    return run_json(run).at("frames").at(frame).at("ranges").at("bar");
  }
};

TEST_F(FieldsInColor, TheRangeIsThatOfTheSequence) {
  expect(0, run("r", stress));
  expect(0, {"export", at("r").string(), "--format", "ply", "--fields", "von_mises", "--quiet"});
  double low = INFINITY, high = -INFINITY;
  for (int frame = 0; frame < 6; ++frame) {
    // Its body has x, y, z and the stress of each vertex first, in double precision.
    std::istringstream ply(read_all(at("r") / "export" / ("frame_000" + std::to_string(frame) + ".ply")));
    std::string line;
    int vertices = 0;
    while (std::getline(ply, line) && line != "end_header")
      if (line.starts_with("element vertex ")) vertices = std::stoi(line.substr(15));
    for (int v = 0; v < vertices; ++v) {
      std::array<double, 4> values{};
      ply.read(reinterpret_cast<char*>(values.data()), sizeof values);
      const double value = values[3];
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  ASSERT_GT(high, low);
  for (std::size_t frame = 0; frame < 6; ++frame) {
    EXPECT_NEAR(range("r", frame).at(0).get<double>(), low, 1e-5 * high) << frame;
    EXPECT_NEAR(range("r", frame).at(1).get<double>(), high, 1e-5 * high) << frame;
  }
}

TEST_F(FieldsInColor, RunIsSimulateAndRender) {
  expect(0, run("whole", stress));
  expect(0, simulate("r", stress));
  expect(0, render("r"));
  expect_same_run(at("whole"), at("r"));
  expect(0, run("plain", {"--set", "time.frames=6"}));
  EXPECT_NE(read_all(at("whole") / "frames/frame_0003.png"), read_all(at("plain") / "frames/frame_0003.png"));
  EXPECT_FALSE(run_json("plain").at("frames").at(0).contains("ranges"));
  expect(0, render("plain", {"--set", "body.0.look.field=von_mises", "-o", at("look").string()}));
  expect_same_run(at("whole"), at("look"));
}

TEST_F(FieldsInColor, OneThreadOrTwo) {
  expect(0, run("whole", stress));
  expect(0, run("one", stress + Arguments{"--threads", "1"}));
  expect_same_run(at("whole"), at("one"));
}

TEST_F(FieldsInColor, AgainHasNothingToDo) {
  expect(0, run("r", stress));
  const auto before = tree(at("r"));
  for (const Arguments& again : {run("r", stress), render("r")}) {
    expect(0, again);
    EXPECT_EQ(tree(at("r")), before);
  }
}

TEST_F(FieldsInColor, AfterKills) {
  expect(0, run("whole", stress));
  for (const char* const file :
       {"records/frame_0003.json", "frames/frame_0001.png", "frames/frame_0004.png"}) {
    Program program(run("r", stress));
    ASSERT_TRUE(program.wait_until([&] { return fs::exists(at("r") / file); }));
    program.signal(SIGKILL);
    EXPECT_EQ(program.wait().status, 128 + SIGKILL);
  }
  expect(0, run("r", stress));
  expect_same_run(at("whole"), at("r"));
}

/// More states may widen the range: what was drawn in the narrower one is drawn again.
TEST_F(FieldsInColor, ByMoreFrames) {
  expect(0, run("whole", stress));
  expect(0, run("r", stress + Arguments{"--frames", "0..1"}));
  EXPECT_EQ(count_files(at("r") / "frames"), 2);
  const auto narrow = range("r", 0);
  expect(0, run("r", stress + Arguments{"--frames", "4..5"}));
  expect(0, run("r", stress));
  EXPECT_NE(range("r", 0), narrow);
  expect_same_run(at("whole"), at("r"));
}

TEST_F(FieldsInColor, AGivenRangeNeedsNoFirstPass) {
  const Arguments given = stress + Arguments{"--set", "body.0.look.range=[0, 500]"};
  expect(0, run("r", given));
  EXPECT_EQ(range("r", 2), (nlohmann::json{0.0, 500.0}));
  expect(0, run("shards", given + Arguments{"--frames", "0..2"}));
  const std::string first = read_all(at("shards") / "frames/frame_0000.png");
  expect(0, run("shards", given));
  EXPECT_EQ(read_all(at("shards") / "frames/frame_0000.png"), first);
  expect_same_run(at("r"), at("shards"));
}

TEST_F(FieldsInColor, ThePathTracerToo) {
  backend_ = "path";
  expect(0, run("whole", stress + Arguments{"--set", "time.frames=3"}));
  expect(0, run("r", stress + Arguments{"--set", "time.frames=3", "--frames", "2"}));
  expect(0, run("r", stress + Arguments{"--set", "time.frames=3"}));
  expect_same_run(at("whole"), at("r"));
}

TEST_F(FieldsInColor, GoodFramesAreDrawnWhereTheSimulationEnds) {
  const Arguments hopeless =
      stress + Arguments{"--set", "solver.max_iterations=1", "--set", "solver.max_halvings=0",
                         "--set", "solver.tolerance=1e-12"};
  expect(3, run("r", hopeless));
  EXPECT_EQ(count_files(at("r") / "frames"), count_files(at("r") / "states"));
  EXPECT_GE(count_files(at("r") / "frames"), 1);
}

TEST_F(FieldsInColor, WrongKeysAreTold) {
  const auto said = [&](const std::string& set) { return expect(2, run("r", {"--set", set})); };
  EXPECT_NE(said("body.0.look.field=von_misses")
                .find("unknown body.0.look.field 'von_misses'; did you mean 'von_mises'? Known are none, "
                      "von_mises, J, energy_density, displacement, young, poisson, density, body"),
            std::string::npos);
  EXPECT_NE(said("body.0.look.colormap=jet")
                .find("unknown body.0.look.colormap 'jet'; known are auto, viridis, magma, plasma, inferno, "
                      "cividis, coolwarm, gray"),
            std::string::npos);
  EXPECT_NE(said("body.0.look.range=[2, 1]").find("the first must be less than the second"),
            std::string::npos);
  EXPECT_NE(said("body.0.look.range=[1]").find("must be an array of 2 numbers"), std::string::npos);
  EXPECT_NE(said("body.0.look.color_bar=1").find("must be true or false"), std::string::npos);
  EXPECT_FALSE(fs::exists(at("r")));
}

}  // namespace fields_in_color_test
}  // namespace lagomorph::tests
