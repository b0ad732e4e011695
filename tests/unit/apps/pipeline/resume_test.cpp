#include <csignal>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/unit/apps/pipeline/run_fixture.h"

/// Whole, killed and resumed, in shards, with one thread or two: the same bytes.
namespace lagomorph::tests {
namespace resume_test {

namespace fs = std::filesystem;

const Arguments eight = {"--set", "time.frames=8"};

class Resume : public ProgramRun {
protected:
  void SetUp() override {
    backend_ = "raster";
    expect(0, run("whole", eight));
  }
};

TEST_F(Resume, OneThreadOrTwo) {
  for (const char* threads : {"1", "2", "5"}) {
    expect(0, run(threads, eight + Arguments{"--threads", threads}));
    expect_same_run(at("whole"), at(threads));
  }
}

TEST_F(Resume, AfterKills) {
  for (const char* frame : {"0001", "0004", "0006"}) {
    Program program(run("r", eight));
    const fs::path record = at("r") / "records" / (std::string("frame_") + frame + ".json");
    ASSERT_TRUE(program.wait_until([&] { return fs::exists(record); }));
    program.signal(SIGKILL);
    EXPECT_EQ(program.wait().status, 128 + SIGKILL);
  }
  dir_.write("r/states/.frame_0006.npy.1.tmp", "half");
  dir_.write("r/frames/frame_0007.png", "a picture without a record");
  expect(0, run("r", eight));
  expect_same_run(at("whole"), at("r"));
}

// A level of history and its time come back from disk, so that no step is made anew by backward Euler.
TEST_F(Resume, OfAMultistepScheme) {
  const Arguments bdf2 = eight + Arguments{"--set", "time.integrator=bdf2", "--set", "time.substeps=2"};
  expect(0, simulate("bdf2", bdf2));
  expect(0, simulate("r", bdf2 + Arguments{"--frames", "3"}));
  EXPECT_EQ(run_json("r").at("frames").at(2).at("history_times").size(), 1U);
  expect(0, simulate("r", bdf2));
  expect_same_run(at("bdf2"), at("r"));
}

TEST_F(Resume, KilledBeforeTheFirstFrame) {
  Program program(run("r", eight));
  ASSERT_TRUE(program.wait_until([&] { return fs::exists(at("r")); }));
  program.signal(SIGKILL);
  program.wait();
  expect(0, run("r", eight));
  expect_same_run(at("whole"), at("r"));
}

TEST_F(Resume, InShards) {
  expect(0, run("r", eight + Arguments{"--frames", "5..7"}));
  expect(0, run("r", eight + Arguments{"--frames", "0..1"}));
  expect(0, run("r", eight + Arguments{"--frames", "2..4"}));
  expect_same_run(at("whole"), at("r"));
}

TEST_F(Resume, ByMoreFrames) {
  expect(0, run("r", {"--set", "time.frames=3"}));
  expect(0, run("r", eight));
  expect_same_run(at("whole"), at("r"));
}

TEST_F(Resume, MakesAgainWhatIsDamagedOrGone) {
  expect(0, run("r", eight));
  dir_.write("r/states/frame_0002.npy", "damaged");
  dir_.write("r/frames/frame_0003.png", "damaged");
  dir_.write("r/records/frame_0005.json", "{");
  fs::remove(at("r") / "states/frame_0006.npy");
  fs::remove(at("r") / "aov/depth/frame_0007.npy");
  fs::remove(at("r") / "energy.csv");
  expect(0, run("r", eight));
  expect_same_run(at("whole"), at("r"));
}

TEST_F(Resume, AMissingMeshOrInputIsWrittenAgain) {
  expect(0, run("r", eight));
  fs::remove(at("r") / "mesh.msh");
  fs::remove_all(at("r") / "inputs");
  fs::remove(at("r") / "scene.toml");
  expect(0, run("r", eight));
  expect_same_run(at("whole"), at("r"));
}

TEST_F(Resume, AfterAKilledForce) {
  expect(0, run("r", eight + Arguments{"--set", "camera.fov=20"}));
  Program program(run("r", eight + Arguments{"--force"}));
  ASSERT_TRUE(program.wait_until([&] {
    return read_all(at("r") / "run.json") != "" && run_json("r")["scene"]["camera"]["fov"] == 35.0 &&
           fs::exists(at("r") / "frames/frame_0001.png");
  }));
  program.signal(SIGKILL);
  program.wait();
  expect(0, run("r", eight));
  expect_same_run(at("whole"), at("r"));
}

class Interrupt : public ProgramRun, public testing::WithParamInterface<int> {
protected:
  void SetUp() override { backend_ = "raster"; }
};
INSTANTIATE_TEST_SUITE_P(Resume, Interrupt, testing::Values(SIGINT, SIGTERM));

TEST_P(Interrupt, LeavesWholeRecordsAndSaysHowToGoOn) {
  const Arguments many = {"--set", "time.frames=40"};
  Program program(run("r", many));
  ASSERT_TRUE(program.wait_until([&] { return fs::exists(at("r") / "records/frame_0003.json"); }));
  program.signal(GetParam());
  const Ended ended = program.wait();
  EXPECT_EQ(ended.status, 128 + GetParam());
  EXPECT_TRUE(ended.err.starts_with("lagomorph: interrupted with ")) << ended.err;
  EXPECT_NE(ended.err.find("the same command goes on"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find(" of 40 frames and "), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find(" of 40 pictures there"), std::string::npos) << ended.err;
  const auto files = tree(at("r"));
  const nlohmann::json frames = run_json("r").at("frames");
  EXPECT_GE(frames.size(), 4U);
  EXPECT_LT(frames.size(), 40U);
  EXPECT_EQ(static_cast<int>(frames.size()), count_files(at("r") / "records"));
  EXPECT_EQ(static_cast<int>(frames.size()), count_files(at("r") / "states"));
  for (const auto& [name, contents] : files) EXPECT_FALSE(name.ends_with(".tmp")) << name;

  const int last = static_cast<int>(frames.size());
  const Arguments few = {"--set", "time.frames=" + std::to_string(last + 1)};
  expect(0, run("r", few));
  expect(0, run("whole", few));
  expect_same_run(at("whole"), at("r"));
}

}  // namespace resume_test
}  // namespace lagomorph::tests
