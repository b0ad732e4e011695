#include <cstring>
#include <map>
#include <string>

#include "tests/unit/apps/pipeline/run_fixture.h"

/// What `lagomorph check` says of why pictures differ, of runs of the small bar.
namespace lagomorph::tests {
namespace causes_test {

using Json = nlohmann::ordered_json;

class Causes : public ProgramRun {
protected:
  void SetUp() override {
    backend_ = "raster";
    expect(0, run("old"));
    expect(0, {"approve", at("old").string(), at("golden").string(), "--states", "1", "--quiet"});
  }
  /// The causes of a check that fails, by kind; `kinds` in the order that they are told.
  std::map<std::string, std::string> causes(const std::string& run) {
    const Ended ended =
        run_program({"check", at(run).string(), at("golden").string(), "--preset", "exact", "--json"});
    EXPECT_EQ(ended.status, 1) << ended.err;
    std::map<std::string, std::string> causes;
    kinds_.clear();
    const Json report = Json::parse(ended.out);
    for (const Json& cause : report.at("causes")) {
      causes[cause.at("kind")] = cause.at("text");
      kinds_.push_back(cause.at("kind"));
    }
    return causes;
  }
  void change_golden(const Json& patch) const {
    Json json = Json::parse(read_all(at("golden/run.json")));
    json.merge_patch(patch);
    dir_.write("golden/run.json", json.dump());
  }
  std::vector<std::string> kinds_;
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(Causes, AnotherMaterialMovesVertices) {
  expect(0, run("new", {"--set", "body.0.material.young=5e4"}));
  std::map<std::string, std::string> told = causes("new");
  EXPECT_EQ(kinds_, (std::vector<std::string>{"scene", "simulation"}));
  EXPECT_TRUE(has(told["scene"],
                  "1 key differs from the golden's, which the simulation depends on: "
                  "body.0.material.young"))
      << told["scene"];
  EXPECT_TRUE(has(told["scene"], "-> 50000.0")) << told["scene"];
  const std::string& text = told["simulation"];
  EXPECT_TRUE(has(text, "states differ from frame 1 on, 3 of 4; vertex ")) << text;
  EXPECT_TRUE(has(text, " m in frame 3 (3 states of both sides compared)")) << text;
  EXPECT_TRUE(has(text, "energies part most in frame 3, ")) << text;
}

TEST_F(Causes, TheVertexThatMovedMost) {
  expect(0, run("new", {"--set", "camera.fov=20"}));
  // A state of the golden with one vertex 0.25 m away: the header's 128 bytes, then positions.
  std::string state = read_all(at("golden/states/frame_0002.npy"));
  double y = 0;
  char* place = state.data() + 128 + sizeof y * (3 * 5 + 1);
  std::memcpy(&y, place, sizeof y);
  y += 0.25;
  std::memcpy(place, &y, sizeof y);
  dir_.write("golden/states/frame_0002.npy", state);
  Json frames = Json::parse(read_all(at("old/run.json"))).at("frames");
  frames[2]["state_sha256"] = "another";
  change_golden({{"frames", frames}});
  const std::string text = causes("new")["simulation"];
  EXPECT_TRUE(has(text,
                  "states differ from frame 2 on, 1 of 4; vertex 5 of body 'bar' is the furthest from "
                  "the golden's place, by 0.25 m in frame 2 (1 state of both sides compared)"))
      << text;
}

TEST_F(Causes, AnotherCameraIsDrawingAlone) {
  expect(0, run("new", {"--set", "camera.fov=20"}));
  std::map<std::string, std::string> told = causes("new");
  EXPECT_EQ(kinds_, (std::vector<std::string>{"scene", "renderer"}));
  EXPECT_TRUE(has(told["scene"], "which only pictures depend on: camera.fov ")) << told["scene"];
  EXPECT_TRUE(has(told["renderer"], "only the drawing differs")) << told["renderer"];
}

TEST_F(Causes, AnotherBuildAndMachine) {
  expect(0, run("new", {"--set", "camera.fov=20"}));
  change_golden({{"lagomorph", "0.0.1"},
                 {"dependencies", {{"cholmod", "2.9"}}},
                 {"machine", {{"cpu", "an older one"}}}});
  std::map<std::string, std::string> told = causes("new");
  EXPECT_EQ(kinds_, (std::vector<std::string>{"scene", "build", "machine", "renderer"}));
  EXPECT_TRUE(has(told["build"], "lagomorph 0.0.1 -> ")) << told["build"];
  EXPECT_TRUE(has(told["build"], "cholmod 2.9 -> ")) << told["build"];
  EXPECT_TRUE(has(told["machine"], "cpu an older one -> ")) << told["machine"];
  change_golden({{"lagomorph", Json(run_json("new").at("lagomorph"))},
                 {"keys", {{"simulation_build", {{"build.simulation", "\"0\""}}}}}});
  EXPECT_TRUE(has(causes("new")["build"], "of other sources for the simulation"));
}

TEST_F(Causes, ThreadsChangeNoByte) {
  expect(0, run("new", {"--set", "camera.fov=20", "--threads", "1"}));
  change_golden({{"machine", {{"threads", 7}}}});
  EXPECT_EQ(causes("new")["machine"], "threads 7 -> 1 (no byte should depend on it)");
}

// The golden's run.json tells the scene of the run that most of it came from.
TEST_F(Causes, OfFramesThatWereApprovedFromAnotherRun) {
  expect(0, run("other", {"--set", "camera.fov=20"}));
  expect(0, {"approve", at("other").string(), at("golden").string(), "--frames", "3", "--quiet"});
  const Ended ended = run_program({"check", at("old").string(), at("golden").string(), "--preset", "exact"});
  EXPECT_EQ(ended.status, 1) << ended.err;
  EXPECT_FALSE(has(ended.out, "scene: ")) << ended.out;
  EXPECT_TRUE(has(ended.out, "renderer: only the drawing differs")) << ended.out;
}

TEST_F(Causes, NoStoryNoCause) {
  expect(0, run("new", {"--set", "camera.fov=20"}));
  std::filesystem::remove(at("golden/run.json"));
  EXPECT_TRUE(causes("new").empty());
  dir_.write("golden/run.json", "{");
  EXPECT_TRUE(causes("new").empty());
  const Ended ended = run_program({"check", at("new").string(), at("golden").string()});
  EXPECT_TRUE(has(ended.out, "so that causes cannot be told")) << ended.out;
}

TEST_F(Causes, StatesAreKeptByGoldenToml) {
  EXPECT_EQ(count_files(at("golden/states")), 4);
  dir_.write("golden/golden.toml", "states_every = 2\n");
  expect(0, {"approve", at("old").string(), at("golden").string(), "--force", "--quiet"});
  EXPECT_EQ(count_files(at("golden/states")), 2);
  const std::string refused =
      expect(2, {"approve", at("old").string(), at("golden").string(), "--states", "3"});
  EXPECT_TRUE(has(refused, "says states_every = 2; change it there")) << refused;
  expect(2, {"approve", at("old").string(), at("golden").string(), "--states", "-1"});
}

}  // namespace causes_test
}  // namespace lagomorph::tests
