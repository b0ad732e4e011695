#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/hash.h"
#include "apps/npy.h"
#include "apps/pipeline/stopwatch.h"
#include "apps/version.h"
#include "sim/mesh_io.h"
#include "tests/unit/apps/pipeline/run_fixture.h"

namespace lagomorph::tests {
namespace run_command_test {

namespace fs = std::filesystem;
using apps::sha256;

class RunCommand : public ProgramRun {};

/// The contract's files, by each back end.
class EachBackEnd : public ProgramRun, public testing::WithParamInterface<const char*> {};
INSTANTIATE_TEST_SUITE_P(RunCommand, EachBackEnd, testing::Values("raster"));

TEST_P(EachBackEnd, LeavesTheContractsFiles) {
  EXPECT_EQ(expect(0, run("r", {"--backend", GetParam()})), "");
  const auto files = tree(at("r"));
  std::vector<std::string> expected = {"energy.csv", "inputs/bar.msh", "inputs/prism.obj",
                                       "mesh.msh",   "run.json",       "scene.toml"};
  for (const char* k : {"0", "1", "2", "3"}) {
    const std::string frame = std::string("/frame_000") + k;
    for (const std::string& name : {"aov/depth" + frame + ".npy", "frames" + frame + ".png",
                                    "records" + frame + ".json", "states" + frame + ".npy"}) {
      expected.push_back(name);
    }
  }
  std::vector<std::string> there;
  for (const auto& [name, contents] : files) there.push_back(name);
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(there, expected);

  const nlohmann::json json = run_json("r");
  EXPECT_EQ(json.at("lagomorph"), apps::version());
  EXPECT_EQ(json.at("name"), "bar");
  EXPECT_EQ(json.at("scene").at("render").at("backend"), GetParam());
  EXPECT_EQ(json.at("scene").at("time").at("frames"), 4);
  EXPECT_EQ(json.at("mesh").at("vertices"), 63);
  EXPECT_EQ(json.at("mesh").at("tets"), 144);
  EXPECT_FALSE(json.at("dependencies").at("renderer").get<std::string>().empty());
  EXPECT_EQ(json.at("dependencies").at("blas_threads"), 1);
  ASSERT_EQ(json.at("frames").size(), 4U);
  for (int k = 0; k < 4; ++k) {
    const nlohmann::json& frame = json["frames"][static_cast<std::size_t>(k)];
    const std::string name = "frame_000" + std::to_string(k);
    EXPECT_EQ(frame.at("frame"), k);
    EXPECT_EQ(frame.at("time"), k / 30.0);
    EXPECT_EQ(frame.at("state_sha256"), sha256(files.at("states/" + name + ".npy")));
    EXPECT_EQ(frame.at("picture_sha256"), sha256(files.at("frames/" + name + ".png")));
    EXPECT_EQ(frame.at("newton_iterations").get<int>() > 0, k > 0);
    const nlohmann::json& solves = frame.at("solves");
    EXPECT_EQ(solves.at("factorizations").get<int>() + solves.at("cg_iterations").get<int>() +
                      solves.at("factor_iterations").get<int>() >
                  0,
              k > 0);
    EXPECT_LE(frame.at("residual").get<double>(), 1e-6);
    for (const char* part : {"simulation", "rendering", "writing"}) {
      EXPECT_GE(frame.at("seconds").at(part).get<double>(), 0.0);
    }
    EXPECT_EQ(apps::read_npy(files.at("states/" + name + ".npy"), name).shape,
              (std::vector<std::size_t>{1, 2, 63, 3}));
    EXPECT_NE(files.at("aov/depth/" + name + ".npy").find("'<f4', 'fortran_order': False, 'shape': (48, 64)"),
              std::string::npos);
    EXPECT_EQ(files.at("frames/" + name + ".png").substr(1, 3), "PNG");
  }
  EXPECT_NE(files.at("frames/frame_0000.png"), files.at("frames/frame_0003.png"));
}

TEST_F(RunCommand, Frame0IsTheInitialState) {
  expect(0, simulate("r"));
  sim::Remarks remarks;
  const sim::TetMesh mesh = sim::read_tet_mesh(data_file("run/bar.msh"), remarks);
  const auto state = apps::read_npy(read_all(at("r") / "states/frame_0000.npy"), "state").values;
  ASSERT_EQ(state.size(), 6U * 63U);
  for (int i = 0; i < 63; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(state[static_cast<std::size_t>(3 * i + axis)], mesh.X(i, axis));
    const bool pinned = mesh.X(i, 1) > 0.6 - 0.1 * 0.6;
    EXPECT_EQ(state[static_cast<std::size_t>(3 * (63 + i))], pinned ? 0.0 : 0.5);
  }
}

TEST_F(RunCommand, TheMeshIsInTheOrderOfTheStates) {
  expect(0, simulate("r", {"--set", "body.0.translate=[0, 1, 0]"}));
  sim::Remarks remarks;
  const sim::TetMesh mesh = sim::read_tet_mesh(at("r") / "mesh.msh", remarks);
  const auto state = apps::read_npy(read_all(at("r") / "states/frame_0000.npy"), "state").values;
  for (int i = 0; i < 63; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(state[static_cast<std::size_t>(3 * i + axis)], mesh.X(i, axis));
  }
  EXPECT_EQ(mesh.tags, std::vector<int>(144, 1));
}

TEST_F(RunCommand, EnergyHasTheColumnsOfTheContract) {
  expect(0, simulate("r"));
  std::istringstream lines(read_all(at("r") / "energy.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_TRUE(line.starts_with("frame,time,kinetic,elastic,gravitational,total,")) << line;
  int rows = 0;
  for (; std::getline(lines, line); ++rows) {
    std::istringstream fields(line);
    std::vector<double> values;
    for (std::string field; std::getline(fields, field, ',');) values.push_back(std::stod(field));
    EXPECT_EQ(values[0], rows);
    EXPECT_EQ(values[1], rows / 30.0);
    EXPECT_EQ(values[5], values[2] + values[3] + values[4]);
    EXPECT_NEAR(values[6], 24.0, 1e-12) << "mass";
  }
  EXPECT_EQ(rows, 4);
}

/// Driven by a file, let go and pushed: RUN holds the file, and goes on from any frame to the same bytes.
TEST_F(RunCommand, ADrivenBodyIsResumedToTheSameBytes) {
  const std::vector<double> shift = {0, 0, 0, 0.01, 0, 0, 0.03, 0.01, 0, 0.06, 0, 0};
  dir_.write("path.npy", apps::npy_bytes(shift, std::array<std::size_t, 2>{4, 3}));
  const Arguments driven = {"--set", "body.0.pin.0.path='" + at("path.npy").string() + "'",
                            "--set", "body.0.pin.0.release=0.07",
                            "--set", "body.0.load.0={top=0.5, force=[3, 0, 0], curve=[[0, 0], [0.1, 1]]}",
                            "--set", "body.0.spring.0={bottom=0.1, stiffness=10}",
                            "--set", "body.0.spin=[0, 1, 0]"};
  expect(0, simulate("whole", driven));
  expect(0, simulate("parts", driven + Arguments{"--frames", "0..1"}));
  expect(0, simulate("parts", driven + Arguments{"--frames", "2"}));
  expect(0, simulate("parts", driven));
  for (const std::string name : {"energy.csv", "states/frame_0003.npy", "inputs/path.npy"})
    EXPECT_EQ(read_all(at("whole") / name), read_all(at("parts") / name)) << name;
  fs::remove(at("path.npy"));
  expect(0, {"simulate", (at("whole") / "scene.toml").string(), "-o", at("again").string(), "--quiet"});
  EXPECT_EQ(read_all(at("whole") / "energy.csv"), read_all(at("again") / "energy.csv"));
  const nlohmann::json frames = run_json("whole").at("frames");
  EXPECT_EQ(frames[0].at("pin_forces").size(), 0U);
  EXPECT_EQ(frames[1].at("pin_forces").size(), 1U);
  EXPECT_NE(frames[1].at("work_pins"), 0.0);
  EXPECT_EQ(frames[3].at("pin_forces")[0][1], 0.0);  // released
}

TEST_F(RunCommand, DefaultsToOutAndTheName) {
  fs::create_directories(at("here"));
  expect(0,
         {"simulate", data_file("run/bar.toml").string(), "--set", "time.frames=1", "--set", "name=beam",
          "--quiet"},
         {.directory = at("here")});
  EXPECT_TRUE(fs::exists(at("here") / "out/beam/run.json"));
}

TEST_F(RunCommand, AgainWithNothingChangedSaysSoAndIsQuick) {
  expect(0, run("r"));
  const auto before = tree(at("r"));
  const auto written = fs::last_write_time(at("r") / "run.json");
  Arguments loud = run("r");
  loud.erase(std::find(loud.begin(), loud.end(), "--quiet"));
  const apps::Stopwatch watch;
  const std::string said = expect(0, loud);
  EXPECT_LT(watch.seconds(), 2.0);
  EXPECT_EQ(said, at("r").string() + ": nothing to do: 4 frames are there and match\n");
  EXPECT_EQ(tree(at("r")), before);
  EXPECT_EQ(fs::last_write_time(at("r") / "run.json"), written);
}

TEST_F(RunCommand, SaysWhatItDoesOnStderrOnly) {
  Arguments loud = run("r");
  loud.erase(std::find(loud.begin(), loud.end(), "--quiet"));
  const Ended ended = run_program(loud);
  EXPECT_EQ(ended.out, "");
  for (const char* part : {"bar.msh: 63 vertices, 144 tets, 0.2 x 0.6 x 0.2 m", "4 frames to make, about ",
                           "frame 4 of 4, ", "4 states simulated", "4 pictures drawn"}) {
    EXPECT_NE(ended.err.find(part), std::string::npos) << part << " is not in " << ended.err;
  }
  EXPECT_EQ(ended.err.find('\r'), std::string::npos);
}

TEST_F(RunCommand, JsonIsTheResultAndNothingElse) {
  const auto result = [&](const Arguments& arguments) {
    return nlohmann::json::parse(run_program(arguments + Arguments{"--json"}).out);
  };
  const nlohmann::json first = result(run("r"));
  EXPECT_EQ(first.at("run"), at("r").string());
  EXPECT_EQ(first.at("status"), "done");
  EXPECT_EQ(first.at("frames"), 4);
  EXPECT_EQ(first.at("states").at("made"), 4);
  EXPECT_EQ(first.at("pictures").at("made"), 4);
  EXPECT_TRUE(first.at("video").is_null());
  const nlohmann::json second = result(run("r"));
  EXPECT_EQ(second.at("pictures").at("made"), 0);
  EXPECT_EQ(second.at("pictures").at("there"), 4);
}

TEST_F(RunCommand, FramesAreStatesToTheLastAndPicturesOfThese) {
  expect(0, run("r", {"--frames", "1..2"}));
  EXPECT_EQ(count_files(at("r") / "states"), 3);
  EXPECT_EQ(count_files(at("r") / "frames"), 2);
  EXPECT_FALSE(fs::exists(at("r") / "frames/frame_0000.png"));
  EXPECT_EQ(run_json("r").at("frames").size(), 3U);
  const std::string energy = read_all(at("r") / "energy.csv");
  EXPECT_EQ(std::count(energy.begin(), energy.end(), '\n'), 4);
  expect(0, run("r", {"--frames", "0"}));
  EXPECT_EQ(count_files(at("r") / "states"), 3);
  EXPECT_EQ(count_files(at("r") / "frames"), 3);
  expect(0, simulate("r", {"--frames", "3"}));
  EXPECT_EQ(count_files(at("r") / "states"), 4);
  EXPECT_EQ(count_files(at("r") / "frames"), 3);
}

TEST_F(RunCommand, FramesThatTheSceneHasNotWriteNothing) {
  for (const char* frames : {"0..4", "4", "3..200"}) {
    EXPECT_NE(expect(2, run("r", {"--frames", frames})).find("the scene has frames 0..3"), std::string::npos);
  }
  expect(2, run("r", {"--frames", "2..1"}));
  EXPECT_FALSE(fs::exists(at("r")));
}

TEST_F(RunCommand, WrongInputWritesNothing) {
  dir_.write("empty.obj", "");
  for (const Arguments& wrong :
       std::vector<Arguments>{{"--set", "body.0.mesh='missing.msh'"},
                              {"--set", "body.0.surface.mesh='" + at("empty.obj").string() + "'"},
                              {"--set", "body.0.surface.mesh='bar.msh'"},
                              {"--set", "camera.look_at=[0, 0.4, 2]"},
                              {"--set", "body.0.pin.0.vertices=[63]"},
                              {"--set", "body.0.scale=0.5", "--set", "body.0.material.poisson=0.5"}}) {
    const std::string said = expect(2, run("r", wrong));
    EXPECT_TRUE(said.starts_with("lagomorph: error: ")) << said;
    EXPECT_FALSE(fs::exists(at("r"))) << said;
  }
}

TEST_F(RunCommand, AFileInThePlaceOfTheRunIsWrongInput) {
  dir_.write("r", "mine");
  expect(2, run("r"));
  expect(2, run("r/below"));
  EXPECT_EQ(read_all(at("r")), "mine");
}

TEST_F(RunCommand, AFolderOfOthersIsNotTouched) {
  dir_.write("r/scene.toml", "name = 'mine'\n");
  EXPECT_NE(expect(2, run("r", {"--force"})).find("is no run"), std::string::npos);
  EXPECT_EQ(tree(at("r")).size(), 1U);
}

TEST_F(RunCommand, AnotherSceneIsRefusedByItsKeys) {
  expect(0, run("r"));
  const auto before = tree(at("r"));
  const std::string said = expect(
      2, run("r", {"--set", "body.0.density=500", "--set", "camera.fov=20", "--set", "render.samples=8"}));
  for (const char* part : {"body.0.density default -> 500.0", "camera.fov default -> 20.0",
                           "render.samples 4 -> 8", "--force"}) {
    EXPECT_NE(said.find(part), std::string::npos) << part << " is not in " << said;
  }
  EXPECT_NE(expect(2, run("r", {"--backend", "raster"})).find("render.backend \"null\" -> default"),
            std::string::npos);
  expect(2, simulate("r", {"--set", "time.substeps=2"}));
  EXPECT_EQ(tree(at("r")), before);
}

TEST_F(RunCommand, NameAndFramesMakeNoOtherRun) {
  expect(0, run("r"));
  const auto state = fs::last_write_time(at("r") / "states/frame_0003.npy");
  expect(0, run("r", {"--set", "name=other", "--set", "time.frames=5"}));
  EXPECT_EQ(run_json("r").at("frames").size(), 5U);
  EXPECT_EQ(run_json("r").at("name"), "other");
  EXPECT_EQ(fs::last_write_time(at("r") / "states/frame_0003.npy"), state);
  expect(0, run("r", {"--set", "time.frames=2"}));
  EXPECT_EQ(run_json("r").at("frames").size(), 2U);
  EXPECT_EQ(count_files(at("r") / "states"), 5) << "what was made stays";
  expect(0, run("r", {"--set", "time.frames=5"}));
  EXPECT_EQ(fs::last_write_time(at("r") / "states/frame_0003.npy"), state);
}

TEST_F(RunCommand, ForceMakesAnewOnlyWhatDoesNotMatch) {
  expect(0, run("r"));
  const auto state = fs::last_write_time(at("r") / "states/frame_0003.npy");
  const Arguments closer = {"--set", "camera.fov=20"};
  expect(0, run("r", Arguments{"--force", "--frames", "0..1"} + closer));
  EXPECT_EQ(fs::last_write_time(at("r") / "states/frame_0003.npy"), state) << "states match";
  EXPECT_EQ(count_files(at("r") / "frames"), 2) << "no picture of the other look stays";
  EXPECT_EQ(count_files(at("r") / "aov/depth"), 2);
  expect(0, run("r", closer));
  expect(0, run("fresh", closer));
  expect_same_run(at("r"), at("fresh"));

  expect(0, run("r", Arguments{"--force", "--set", "body.0.density=500"}));
  expect(0, run("fresh2", {"--set", "body.0.density=500"}));
  expect_same_run(at("r"), at("fresh2"));
}

TEST_F(RunCommand, SimulateThenRunIsRun) {
  expect(0, simulate("r"));
  EXPECT_FALSE(fs::exists(at("r") / "frames") && count_files(at("r") / "frames") > 0);
  EXPECT_TRUE(run_json("r").at("hashes").at("picture").is_null());
  expect(0, run("r"));
  expect(0, run("whole"));
  expect_same_run(at("r"), at("whole"));
  expect(0, simulate("r"));
  expect_same_run(at("r"), at("whole"));
}

TEST_F(RunCommand, TheRunsSceneGivesTheSameRun) {
  expect(0, run("r", {"--backend", "raster"}));
  fs::rename(at("r"), at("moved"));
  expect(0, {"run", (at("moved") / "scene.toml").string(), "-o", at("again").string(), "--quiet"});
  expect_same_run(at("moved"), at("again"));
  expect(0, {"run", (at("moved") / "scene.toml").string(), "-o", at("moved").string(), "--quiet"});
  expect_same_run(at("moved"), at("again"));
}

TEST_F(RunCommand, TwoAtOnceInOnePlaceAreRefused) {
  Program first(run("r", {"--set", "time.frames=9000"}));
  ASSERT_TRUE(first.wait_until([&] { return fs::exists(at("r") / "records/frame_0001.json"); }));
  EXPECT_NE(expect(2, run("r", {"--set", "time.frames=9000"})).find("another lagomorph is writing this run"),
            std::string::npos);
  EXPECT_TRUE(first.is_running()) << "it was not disturbed";
}

TEST_F(RunCommand, AnUnconvergedStepEndsTheRunWithTheLastGoodFrame) {
  // One Newton iteration and no halving: the first step that needs two cannot be made.
  const Arguments hard = {"--set", "solver.max_iterations=1", "--set", "solver.max_halvings=0",
                          "--set", "solver.tolerance=1e-12"};
  const std::string said = expect(3, run("r", hard));
  EXPECT_TRUE(said.starts_with("lagomorph: error: frame 1: ")) << said;
  EXPECT_EQ(count_files(at("r") / "states"), 1);
  EXPECT_EQ(count_files(at("r") / "frames"), 1);
  EXPECT_EQ(run_json("r").at("frames").size(), 1U);
  const Ended again = run_program(run("r", hard + Arguments{"--json"}));
  EXPECT_EQ(again.status, 3);
  EXPECT_EQ(nlohmann::json::parse(again.out).at("status"), "failed");
}

}  // namespace run_command_test
}  // namespace lagomorph::tests
