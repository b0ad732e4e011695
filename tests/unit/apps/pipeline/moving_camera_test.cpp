#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/unit/apps/pipeline/run_fixture.h"

/// Runs whose camera moves or depends on the bodies.
namespace lagomorph::tests {
namespace moving_camera_test {

const Arguments moves = {"--set", "camera.turntable.turns=1",    "--set", "camera.frame=motion",
                         "--set", "camera.follow=center_of_mass"};

class MovingCamera : public ProgramRun {
protected:
  void SetUp() override { backend_ = "raster"; }
  std::string picture(const std::string& run, int frame) const {
    return read_all(at(run) / ("frames/frame_000" + std::to_string(frame) + ".png"));
  }
};

TEST_F(MovingCamera, IsTheSameInARunInPartsAndLater) {
  for (const char* const backend : {"raster", "path"}) {
    backend_ = backend;
    const std::string whole = std::string("whole ") + backend, parts = std::string("parts ") + backend,
                      later = std::string("later ") + backend;
    expect(0, run(whole, moves));
    EXPECT_NE(picture(whole, 0), picture(whole, 2));
    expect(0, run(parts, moves + Arguments{"--frames", "0..1"}));
    expect(0, run(parts, moves));
    expect_same_run(at(whole), at(parts));
    expect(0, simulate(later, moves));
    expect(0, render(later, {"--frames", "3"}));
    EXPECT_EQ(picture(later, 3), picture(whole, 3));
  }
}

TEST_F(MovingCamera, ALensThatOnlyKeysHaveIsToldToBeLeftOut) {
  const auto said = [&](const char* backend) {
    return run_program({"run", data_file("run/bar.toml").string(), "-o", at(backend).string(), "--frames",
                        "0", "--backend", backend, "--set",
                        "camera.key=[{ frame = 0, f_stop = 0 }, { frame = 4, f_stop = 2 }]"})
        .err;
  };
  EXPECT_NE(said("raster").find("raster: camera.f_stop: everything is drawn sharp\n"), std::string::npos);
  EXPECT_EQ(said("path").find("drawn sharp"), std::string::npos);
}

/// RUN/scene.toml says all of the camera.
TEST_F(MovingCamera, IsWhatTheRunSaysOfIt) {
  backend_ = "null";
  const Arguments more = {"--set", "camera.key.0.frame=1",  "--set", "camera.key.0.fov=21.3",
                          "--set", "camera.view=isometric", "--set", "panel.0.zoom=1.7",
                          "--set", "panel.1.view=top",      "--set", "camera.margin=0.123"};
  expect(0, run("r", moves + more));
  const auto before = tree(at("r"));
  expect(0, {"run", (at("r") / "scene.toml").string(), "-o", at("r").string(), "--quiet"});
  EXPECT_EQ(tree(at("r")), before);
}

TEST_F(MovingCamera, EndsWhereItsTurnsAreSpread) {
  expect(0, run("r", moves));
  const std::string said = expect(2, run("r", moves + Arguments{"--set", "time.frames=5"}));
  EXPECT_NE(said.find("is another run: time.frames 4 -> 5"), std::string::npos) << said;
}

/// A camera by period goes on where more frames are asked for.
TEST_F(MovingCamera, ByPeriodGoesOn) {
  const Arguments period = {"--set", "camera.turntable.period=0.5"};
  expect(0, run("whole", period + Arguments{"--set", "time.frames=5"}));
  expect(0, run("r", period));
  expect(0, run("r", period + Arguments{"--set", "time.frames=5"}));
  expect_same_run(at("whole"), at("r"));
}

TEST_F(MovingCamera, MoreStatesNeedMoreRoom) {
  const Arguments fit = {"--set", "camera.frame=motion"};
  expect(0, run("whole", fit));
  expect(0, run("r", fit + Arguments{"--frames", "0"}));
  const std::string close = picture("r", 0);
  expect(0, run("r", fit));
  EXPECT_NE(picture("r", 0), close);
  expect_same_run(at("whole"), at("r"));
  const auto box = run_json("r").at("frames").at(0).at("fitted_box");
  EXPECT_EQ(box, run_json("r").at("frames").at(3).at("fitted_box"));
  EXPECT_LT(box.at(0).get<double>(), box.at(3).get<double>());
}

}  // namespace moving_camera_test
}  // namespace lagomorph::tests
