#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "apps/commands.h"
#include "apps/info/info.h"
#include "sim/error.h"
#include "tests/support/temporary_directory.h"

namespace lagomorph::apps {
namespace scene_and_run_info_test {

/// A scene of one tet that stands on its right triangle in y = 0, hung by its apex.
class SmallScene : public testing::Test {
protected:
  SmallScene() {
    directory.write("tet.mesh",
                    "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
                    "Tetrahedra\n1\n1 2 3 4 1\nEnd\n");
    scene = directory.write("small.toml", R"(
[time]
frames = 4
fps = 60
[[body]]
name = "tet"
mesh = "tet.mesh"
density = 600
[[body.pin]]
top = 0.5
[camera]
orthographic = 2
[render]
backend = "null"
width = 16
height = 8
)");
  }
  nlohmann::json run_json() const { return nlohmann::json::parse(run_info(run).json()); }

  tests::TemporaryDirectory directory;
  std::filesystem::path scene, run = directory.path() / "run";
};

TEST_F(SmallScene, IsTold) {
  const Report report = scene_info(scene, {});
  const nlohmann::json json = nlohmann::json::parse(report.json());
  EXPECT_EQ(json["kind"], "scene");
  EXPECT_EQ(json["name"], "small");
  ASSERT_EQ(json["bodies"].size(), 1U);
  EXPECT_EQ(json["bodies"][0]["name"], "tet");
  EXPECT_EQ(json["bodies"][0]["vertices"], 4);
  EXPECT_EQ(json["bodies"][0]["tets"], 1);
  EXPECT_EQ(json["bodies"][0]["pinned"], 1);
  EXPECT_EQ(json["bodies"][0]["triangles"], 4);
  EXPECT_EQ(json["bodies"][0]["model"], "stable_neo_hookean");
  EXPECT_NEAR(json["mass"].get<double>(), 100.0, 1e-10);
  EXPECT_EQ(json["unknowns"], 9);
  EXPECT_EQ(json["time"]["frames"], 4);
  EXPECT_DOUBLE_EQ(json["time"]["seconds"], 0.05);
  EXPECT_EQ(json["pictures"]["width"], 16);
  EXPECT_GT(json["expected_bytes"], 4 * 4 * 6 * 8);  // four states of four vertices
  for (const char* line : {
           "small.toml: scene 'small'\n",
           "\n  body tet      1 tets, 4 vertices (1 pinned) of tet.mesh\n",
           "\n  mass          100 kg\n",
           "\n  time          4 frames at 60 1/s, 0.05 s; backward_euler, 1 step a frame\n",
           "\n  camera        orthographic, 2 m high, from [0, 0.8, 3] to [0, 0.5, 0]\n",
           "\n  pictures      16 x 8 by null\n",
       }) {
    EXPECT_NE(report.text().find(line), std::string::npos) << line << "\nin\n" << report.text();
  }
  const std::vector<std::string> heavier = {"body.0.density=1200"};
  EXPECT_NEAR(nlohmann::json::parse(scene_info(scene, heavier).json())["mass"].get<double>(), 200.0, 1e-10);
}

TEST_F(SmallScene, PinsThatSelectNothingAreToldWithTheirPlace) {
  const auto error_of = [&](const std::vector<std::string>& overrides) -> std::string {
    try {
      scene_info(scene, overrides);
    } catch (const sim::InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(error_of({"body.0.pin.0={ vertices = [4] }"}),
            "--set body.0.pin.0={ vertices = [4] }: body.0.pin.0: vertex 4 is out of range; the body's "
            "vertices are 0 to 3");
  EXPECT_EQ(
      error_of({"body.0.pin.0.box=[[2, 2, 2], [3, 3, 3]]"}).find(scene.string() + ":9:1: body.0.pin.0: box "),
      0U);
}

TEST_F(SmallScene, RunIsTold) {
  Options options;
  options.inputs = {scene.string()};
  options.out = run;
  options.quiet = true;
  options.frames = FrameRange{0, 1};
  ASSERT_EQ(run_command(options), ExitStatus::done);
  nlohmann::json json = run_json();
  EXPECT_EQ(json["kind"], "run");
  EXPECT_EQ(json["name"], "small");
  EXPECT_EQ(json["time"]["frames"], 4);
  EXPECT_EQ(json["time"]["fps"], 60.0);
  EXPECT_EQ(json["states"], nlohmann::json({0, 1}));
  EXPECT_EQ(json["pictures"], nlohmann::json({0, 1}));
  EXPECT_EQ(json["status"], "unfinished");

  options.frames.reset();
  ASSERT_EQ(simulate_command(options), ExitStatus::done);
  EXPECT_EQ(run_json()["status"], "simulated, not all drawn");
  const std::string text = run_info(run).text();
  EXPECT_NE(text.find("\n  states           4 of 4: 0..3\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\n  pictures         2 of 4: 0..1\n"), std::string::npos) << text;

  options.frames = FrameRange{3, 3};
  ASSERT_EQ(run_command(options), ExitStatus::done);
  EXPECT_NE(run_info(run).text().find("\n  pictures         3 of 4: 0..1, 3\n"), std::string::npos);
  options.frames.reset();
  ASSERT_EQ(run_command(options), ExitStatus::done);
  json = run_json();
  EXPECT_EQ(json["status"], "complete");
  EXPECT_EQ(json["simulation_hash"].get<std::string>().size(), 64U);
  EXPECT_GT(json["newton"]["iterations"], 0);

  std::filesystem::remove(run / "states/frame_0002.npy");
  EXPECT_EQ(run_json()["states"], nlohmann::json({0, 1, 3}));
}

TEST_F(SmallScene, WhatIsNoRunIsAnError) {
  EXPECT_THROW(run_info(directory.path()), Error);
  for (const char* text : {"", "{", "[]", "{}", "{\"name\": 3, \"keys\": {}}", "null"}) {
    directory.write("broken/run.json", text);
    try {
      run_info(directory.path() / "broken");
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.status, ExitStatus::wrong_input) << text;
    }
  }
}

}  // namespace scene_and_run_info_test
}  // namespace lagomorph::apps
