#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/unit/apps/pipeline/run_fixture.h"

namespace lagomorph::tests {
namespace motion_blur_test {

namespace fs = std::filesystem;

class MotionBlurRun : public ProgramRun {
protected:
  void SetUp() override { backend_ = "path"; }
  const Arguments open_ = {"--set", "camera.shutter=0.5", "--set", "render.samples=4"};
};

/// A blurred picture is of two states, whichever way it comes about.
TEST_F(MotionBlurRun, IsTheSameInARunInPartsAndLater) {
  expect(0, run("whole", open_));
  expect(0, run("parts", open_ + Arguments{"--frames", "0..1"}));
  expect(0, run("parts", open_));
  expect_same_run(at("whole"), at("parts"));
  expect(0, simulate("later", open_));
  expect(0, render("later", {"--frames", "3"}));
  EXPECT_EQ(read_all(at("later") / "frames/frame_0003.png"), read_all(at("whole") / "frames/frame_0003.png"));
  expect(0, run("sharp", {"--set", "render.samples=4"}));
  EXPECT_NE(read_all(at("sharp") / "frames/frame_0003.png"), read_all(at("whole") / "frames/frame_0003.png"));
  EXPECT_EQ(read_all(at("sharp") / "states/frame_0003.npy"), read_all(at("whole") / "states/frame_0003.npy"));
}

TEST_F(MotionBlurRun, NeedsTheStateBefore) {
  expect(0, run("r", open_));
  fs::remove(at("r") / "states/frame_0001.npy");
  const std::string said = expect(2, render("r", {"--frames", "2..3", "-o", at("other").string()}));
  EXPECT_NE(said.find("frame_0001.npy: is not there"), std::string::npos) << said;
}

TEST_F(MotionBlurRun, TheRasterizerSaysWhatItDrawsInstead) {
  const Ended ended = run_program({"run", (source_dir() / "assets/scenes/motion_blur.toml").string(),
                                   "--frames", "0", "--backend", "raster", "-o", at("r").string(), "--set",
                                   "render.width=64", "--set", "render.height=36"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.err.find("raster: camera.shutter: drawn without motion blur"), std::string::npos)
      << ended.err;
  EXPECT_NE(ended.err.find("raster: a sun is a far square light of its size"), std::string::npos)
      << ended.err;
}

}  // namespace motion_blur_test
}  // namespace lagomorph::tests
