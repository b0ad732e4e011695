#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/pictures.h"
#include "tests/unit/apps/pipeline/run_fixture.h"

namespace lagomorph::tests {
namespace motion_blur_test {

namespace fs = std::filesystem;

class MotionBlurRun : public ProgramRun {
protected:
  void SetUp() override { backend_ = "path"; }
  /// Of frame 1 of two runs, in 255.
  double mean_difference(const std::string& a, const std::string& b) const {
    const auto picture = [&](const std::string& run) {
      return render::read_png(read_all(at(run) / "frames/frame_0001.png"), run);
    };
    const render::Pixels one = picture(a), other = picture(b);
    const auto& x = render::tests::bytes_of(one);
    const auto& y = render::tests::bytes_of(other);
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
      sum += std::abs(static_cast<int>(x[i]) - static_cast<int>(y.at(i)));
    return sum / static_cast<double>(x.size());
  }

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

/// So is one whose camera moves: by keys, around, and with the bodies.
TEST_F(MotionBlurRun, OfTheCameraIsTheSameInARunInPartsAndLater) {
  const Arguments moves = {"--set", "camera.turntable.turns=1",    "--set", "camera.key.0.frame=0",
                           "--set", "camera.key.0.fov=30",         "--set", "camera.key.1.frame=3",
                           "--set", "camera.key.1.fov=20",         "--set", "camera.frame=motion",
                           "--set", "camera.follow=center_of_mass"};
  expect(0, run("whole", open_ + moves));
  expect(0, run("parts", open_ + moves + Arguments{"--frames", "0..1"}));
  expect(0, run("parts", open_ + moves));
  expect_same_run(at("whole"), at("parts"));
  expect(0, simulate("later", open_ + moves));
  expect(0, render("later", {"--frames", "3"}));
  EXPECT_EQ(read_all(at("later") / "frames/frame_0003.png"), read_all(at("whole") / "frames/frame_0003.png"));
}

/// A camera that turns blurs the ground below what hangs still.
TEST_F(MotionBlurRun, OfTheCameraIsSeen) {
  const Arguments turn = {"--set", "camera.turntable.period=1", "--set",    "ground.texture=checker",
                          "--set", "render.samples=64",         "--frames", "1"};
  const Arguments still = {"--set", "body.0.velocity=[0, 0, 0]", "--set", "time.gravity=[0, 0, 0]"};
  expect(0, run("sharp", turn + still));
  expect(0, run("blurred", turn + still + Arguments{"--set", "camera.shutter=1"}));
  EXPECT_GT(mean_difference("sharp", "blurred"), 2.0);
}

/// Bodies that fall freely, and a camera that follows them: nothing moves in the picture.
TEST_F(MotionBlurRun, WhatIsFollowedIsSharp) {
  const Arguments falling = {"--set", "body.0.pin=", "--set",    "ground.enabled=false",
                             "--set", "light=[]",    "--set",    "render.samples=16",
                             "--set", "time.fps=5",  "--frames", "0..1"};
  const Arguments follow = {"--set", "camera.follow=center_of_mass"}, shutter = {"--set", "camera.shutter=1"};
  expect(0, run("sharp", falling + follow));
  expect(0, run("followed", falling + follow + shutter));
  expect(0, run("passing", falling + shutter));
  EXPECT_LT(mean_difference("sharp", "followed"), 0.05);
  EXPECT_GT(mean_difference("sharp", "passing"), 0.5);
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
  EXPECT_NE(ended.err.find("raster: camera.shutter: drawn without motion blur of bodies or camera"),
            std::string::npos)
      << ended.err;
  EXPECT_NE(ended.err.find("raster: a sun is a far square light of its size"), std::string::npos)
      << ended.err;
}

}  // namespace motion_blur_test
}  // namespace lagomorph::tests
