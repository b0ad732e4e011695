#include <algorithm>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/unit/apps/pipeline/run_fixture.h"

namespace lagomorph::tests {
namespace render_command_test {

namespace fs = std::filesystem;

class RenderCommand : public ProgramRun {
protected:
  void SetUp() override { backend_ = "raster"; }
};

TEST_F(RenderCommand, SimulateAndRenderAreRun) {
  expect(0, simulate("r"));
  expect(0, render("r"));
  expect(0, run("whole"));
  expect_same_run(at("whole"), at("r"));
}

TEST_F(RenderCommand, AgainHasNothingToDo) {
  expect(0, run("r"));
  const auto before = tree(at("r"));
  const Ended ended = run_program({"render", at("r").string()});
  EXPECT_EQ(ended.status, 0);
  EXPECT_EQ(ended.err, at("r").string() + ": nothing to do: 4 frames are there and match\n");
  EXPECT_EQ(tree(at("r")), before);
}

TEST_F(RenderCommand, DrawsOnlyTheFramesAsked) {
  expect(0, simulate("r"));
  expect(0, render("r", {"--frames", "1..2"}));
  EXPECT_EQ(count_files(at("r") / "frames"), 2);
  EXPECT_TRUE(fs::exists(at("r") / "frames/frame_0002.png"));
  expect(2, render("r", {"--frames", "4"}));
}

TEST_F(RenderCommand, DrawsTheStatesThatAreThere) {
  expect(0, simulate("r", {"--frames", "2"}));
  const std::string told = run_program({"render", at("r").string()}).err;
  EXPECT_NE(told.find(": draws frames 0..2 of 4, for the state of frame 3 is not there\n"), std::string::npos)
      << told;
  EXPECT_EQ(count_files(at("r") / "frames"), 3);
  const std::string said = expect(2, render("r", {"--frames", "2..3"}));
  EXPECT_NE(said.find("states/frame_0003.npy: is not there; lagomorph simulate"), std::string::npos) << said;
}

TEST_F(RenderCommand, PartOfACacheIsDrawn) {
  expect(0, run("r"));
  for (const char* const file : {"states/frame_0000.npy", "states/frame_0001.npy", "records/frame_0000.json"})
    fs::remove(at("r") / file);
  expect(0, render("r", {"--frames", "3", "-o", at("one").string()}));
  EXPECT_EQ(count_files(at("one") / "frames"), 1);
  expect(0, render("r", {"-o", at("two").string()}));
  EXPECT_EQ(count_files(at("two") / "frames"), 2);
  for (const char* const file : {"frames/frame_0002.png", "frames/frame_0003.png"})
    EXPECT_EQ(read_all(at("two") / file), read_all(at("r") / file));
  EXPECT_NE(expect(2, render("r", {"--frames", "1..2", "-o", at("no").string()}))
                .find("frame_0001.npy: is not there"),
            std::string::npos);
}

TEST_F(RenderCommand, ANewLookElsewhere) {
  expect(0, run("r"));
  const auto before = tree(at("r"));
  const Arguments closer = {"--set", "camera.fov=20"};
  expect(0, render("r", closer + Arguments{"-o", at("closer").string()}));
  EXPECT_EQ(tree(at("r")), before);
  expect(0, run("fresh", closer));
  expect_same_run(at("fresh"), at("closer"));
}

TEST_F(RenderCommand, ElsewhereStandsAlone) {
  expect(0, run("r"));
  expect(0, render("r", {"--backend", "null", "--frames", "1", "-o", at("look").string()}));
  fs::remove_all(at("r"));
  EXPECT_EQ(count_files(at("look") / "frames"), 1);
  EXPECT_EQ(count_files(at("look") / "states"), 4);
  expect(0, render("look"));
  expect(0, run("fresh", {"--backend", "null"}));
  expect_same_run(at("fresh"), at("look"));
  expect(0, {"run", (at("look") / "scene.toml").string(), "-o", at("look").string(), "--quiet", "--set",
             "time.frames=5"});
  EXPECT_EQ(count_files(at("look") / "frames"), 5);
}

TEST_F(RenderCommand, ANewLookInPlaceNeedsForce) {
  expect(0, run("r"));
  const auto before = tree(at("r"));
  const Arguments closer = {"--set", "camera.fov=20"};
  EXPECT_NE(expect(2, render("r", closer)).find("camera.fov default -> 20.0"), std::string::npos);
  EXPECT_NE(expect(2, render("r", {"--backend", "null"})).find("render.backend"), std::string::npos);
  EXPECT_EQ(tree(at("r")), before);
  expect(0, render("r", closer + Arguments{"--force"}));
  expect(0, run("fresh", closer));
  expect_same_run(at("fresh"), at("r"));
}

TEST_F(RenderCommand, LooksAreFreeWhereNothingIsDrawn) {
  expect(0, simulate("r"));
  expect(0, render("r", {"--set", "camera.fov=20"}));
  expect(0, run("fresh", {"--set", "camera.fov=20"}));
  expect_same_run(at("fresh"), at("r"));
}

TEST_F(RenderCommand, ChangesNoPhysics) {
  expect(0, simulate("r"));
  const std::string said = expect(2, render("r", {"--set", "body.0.density=5", "-o", at("other").string()}));
  EXPECT_NE(said.find("body.0.density default -> 5.0"), std::string::npos) << said;
  EXPECT_FALSE(fs::exists(at("other")));
}

TEST_F(RenderCommand, AMovedRunRendersAgain) {
  expect(0, simulate("r"));
  fs::rename(at("r"), at("moved"));
  expect(0, render("moved"));
  EXPECT_EQ(count_files(at("moved") / "frames"), 4);
}

TEST_F(RenderCommand, ADamagedStateIsTold) {
  expect(0, simulate("r"));
  dir_.write("r/states/frame_0002.npy", "damaged");
  const std::string said = expect(2, render("r"));
  EXPECT_NE(said.find("states/frame_0002.npy: is not what its record tells"), std::string::npos) << said;
  EXPECT_FALSE(fs::exists(at("r") / "frames"));
}

TEST_F(RenderCommand, WhatIsNoRunIsTold) {
  fs::create_directories(at("empty"));
  dir_.write("file", "x");
  EXPECT_NE(expect(2, render("missing")).find("there is no such run"), std::string::npos);
  EXPECT_NE(expect(2, render("empty")).find("it has no run.json"), std::string::npos);
  EXPECT_NE(expect(2, render("file")).find("is a file"), std::string::npos);
  expect(0, simulate("r"));
  fs::remove_all(at("r") / "states");
  EXPECT_NE(expect(2, render("r")).find("has no states"), std::string::npos);
}

TEST_F(RenderCommand, SeveralShareTheFrames) {
  expect(0, simulate("r", {"--set", "time.frames=12"}));
  {
    Program a(render("r", {"--frames", "0..3"})), b(render("r", {"--frames", "4..7"})),
        c(render("r", {"--frames", "8..11"}));
    for (Program* program : {&a, &b, &c}) {
      const Ended ended = program->wait();
      EXPECT_EQ(ended.status, 0) << ended.err;
    }
  }
  expect(0, run("whole", {"--set", "time.frames=12"}));
  expect_same_run(at("whole"), at("r"));
}

TEST_F(RenderCommand, CutLightIsToldInALineAndInTheRecord) {
  const Arguments small = {"--set",           "render.width=16", "--set",
                           "render.height=9", "--set",           "render.samples=1"};
  expect(0, simulate("r", {"--frames", "0"}));
  const auto drawn = [&](const Arguments& more) {
    Arguments loud =
        render("r", Arguments{"--backend", "path", "-o", at("p").string(), "--force"} + small + more);
    loud.erase(std::find(loud.begin(), loud.end(), "--quiet"));
    const Ended ended = run_program(loud);
    EXPECT_EQ(ended.status, 0) << ended.err;
    return ended.err;
  };
  const auto record = [&] { return nlohmann::json::parse(read_all(at("p") / "records/frame_0000.json")); };
  EXPECT_EQ(drawn({}).find("clamp"), std::string::npos);
  EXPECT_FALSE(record().contains("clamp"));
  EXPECT_NE(drawn({"--set", "render.path.clamp=3"}).find("path: render.path.clamp = 3: "), std::string::npos);
  EXPECT_EQ(record().at("clamp"), 3.0);
}

TEST_F(RenderCommand, TheRasterizerSaysWhatItDrawsInsteadOfAClearInside) {
  Arguments loud = run("r", {"--frames", "0", "--set", "body.0.look.transmission=1"});
  loud.erase(std::find(loud.begin(), loud.end(), "--quiet"));
  const std::string said = run_program(loud).err;
  EXPECT_NE(said.find("its shadow is as light as it is clear"), std::string::npos) << said;
}

}  // namespace render_command_test
}  // namespace lagomorph::tests
