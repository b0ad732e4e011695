#include "tests/support/check_fixture.h"

/// `lagomorph approve`, and checks of what it leaves.
namespace lagomorph::tests {
namespace approve_command_test {

using Json = nlohmann::json;

class ApproveCommand : public CheckFixture {
protected:
  Ended approve(const std::vector<std::string>& more = {}, const ProgramOptions& options = {}) const {
    std::vector<std::string> arguments = {"approve", at("run").string(), at("golden").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments, options);
  }
  std::string approved(const std::vector<std::string>& more = {}) const {
    const Ended ended = approve(more);
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.err, "");
    return ended.out;
  }
  std::string refused(const std::vector<std::string>& more = {}) const {
    const Ended ended = approve(more);
    EXPECT_EQ(ended.status, 2) << ended.out;
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
    return ended.err;
  }
  std::string golden(const std::string& name) const { return read_all(at("golden") / name); }
  /// Five frames of one picture.
  void five() const {
    for (int frame = 0; frame < 5; ++frame) add_run(frame, flip_file("spheres_ref.png"));
  }
};

TEST_F(ApproveCommand, MakesTheFirstGolden) {
  five();
  dir_.write("run/run.json", R"({"lagomorph": "x", "frames": [{"frame": 0, "picture_sha256": "a"}]})");
  EXPECT_EQ(check().status, 2);  // a missing golden never passes
  const std::string out = approved();
  EXPECT_NE(out.find("frame 0: new\n"), std::string::npos) << out;
  EXPECT_NE(out.find("5 frames accepted, 0 left as they are\n"), std::string::npos) << out;
  EXPECT_EQ(golden("frames/frame_0003.png"), flip_file("spheres_ref.png"));
  EXPECT_EQ(Json::parse(golden("run.json")), Json::parse(read_all(at("run/run.json"))));
  EXPECT_NE(golden("golden.toml").find("preset = \"render\"\n"), std::string::npos);
  EXPECT_EQ(check().status, 0);
  EXPECT_EQ(count_files(at("golden/frames")), 5);
}

TEST_F(ApproveCommand, RenewsWhatFailsAndLeavesWhatPasses) {
  five();
  approved();
  limits("# ours\n");
  const std::string harmless = changed_png("spheres_ref.png", [](double v, std::size_t) { return v + 1; });
  add_run(1, harmless);
  add_run(3, flip_file("spheres_moved.png"));
  const std::string out = approved();
  EXPECT_NE(out.find("frame 3: flip_tile_max 0.2222 at 192,96 (16x16 pixels), limit 0.12"), std::string::npos)
      << out;
  EXPECT_NE(out.find("1 frame accepted, 4 left as they are\n"), std::string::npos) << out;
  EXPECT_EQ(golden("frames/frame_0001.png"), flip_file("spheres_ref.png"));
  EXPECT_EQ(golden("frames/frame_0003.png"), flip_file("spheres_moved.png"));
  EXPECT_EQ(golden("golden.toml"), "# ours\n");
  EXPECT_EQ(check().status, 0);
  EXPECT_NE(approved({"--force"}).find("5 frames accepted"), std::string::npos);
  EXPECT_EQ(golden("frames/frame_0001.png"), harmless);
}

TEST_F(ApproveCommand, OnlyTheFramesAskedFor) {
  five();
  approved();
  for (const int frame : {1, 3}) add_run(frame, flip_file("spheres_moved.png"));
  add_run(7, flip_file("spheres_ref.png"));
  approved({"--frames", "3"});
  EXPECT_EQ(golden("frames/frame_0001.png"), flip_file("spheres_ref.png"));
  EXPECT_EQ(golden("frames/frame_0003.png"), flip_file("spheres_moved.png"));
  EXPECT_FALSE(std::filesystem::exists(at("golden/frames/frame_0007.png")));
  approved({"--frames", "5..7"});
  EXPECT_EQ(golden("frames/frame_0007.png"), flip_file("spheres_ref.png"));
  EXPECT_NE(refused({"--frames", "5..6"}).find("has no picture of the frames"), std::string::npos);
}

TEST_F(ApproveCommand, FromADownloadedReport) {
  five();
  approved();
  add_run(2, flip_file("spheres_moved.png"));
  add_golden(9, flip_file("spheres_ref.png"));  // missing in the run
  EXPECT_EQ(check({"-o", at("ci").string()}).status, 1);
  const std::string report = at("ci/report.json").string();
  add_run(2, flip_file("spheres_missing.png"));
  EXPECT_NE(refused({"--report", report}).find("is another picture than " + report + " judged"),
            std::string::npos);
  EXPECT_EQ(golden("frames/frame_0002.png"), flip_file("spheres_ref.png"));
  add_run(2, flip_file("spheres_moved.png"));
  add_run(4, flip_file("spheres_missing.png"));  // after the report
  const std::string out = approved({"--report", report});
  EXPECT_NE(out.find("missing in the run, so not approved: 9\n"), std::string::npos) << out;
  EXPECT_EQ(golden("frames/frame_0002.png"), flip_file("spheres_moved.png"));
  EXPECT_EQ(golden("frames/frame_0004.png"), flip_file("spheres_ref.png"));
  EXPECT_NE(
      refused({"--report", dir_.write("no.json", "{}").string()}).find("is no report of lagomorph check"),
      std::string::npos);
  dir_.write("no.json", R"({"format": "lagomorph-check-report", "version": 99, "frames": []})");
  EXPECT_NE(refused({"--report", at("no.json").string()}).find("another version"), std::string::npos);
}

TEST_F(ApproveCommand, NothingIsWrittenWhenAPictureIsNone) {
  five();
  add_run(4, "no picture");
  EXPECT_NE(refused().find("frame_0004.png: is no PNG"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(at("golden")));
  add_golden(0, flip_file("spheres_ref.png"));
  EXPECT_NE(refused().find("frame_0004.png: is no PNG"), std::string::npos);
  EXPECT_EQ(count_files(at("golden/frames")), 1);
}

TEST_F(ApproveCommand, AnUnreadableGoldenIsReplaced) {
  five();
  approved();
  add_golden(1, "no picture");
  EXPECT_EQ(rules(report(1)), Json::parse(R"({"1": ["unreadable"]})"));
  approved();
  EXPECT_EQ(check().status, 0);
}

TEST_F(ApproveCommand, VariantsStandBesideTheGolden) {
  five();
  approved();
  add_run(1, flip_file("spheres_moved.png"));
  approved({"--variant", "mac"});
  EXPECT_EQ(golden("variants/mac/frames/frame_0001.png"), flip_file("spheres_moved.png"));
  EXPECT_EQ(golden("frames/frame_0001.png"), flip_file("spheres_ref.png"));
  EXPECT_EQ(count_files(at("golden/variants/mac/frames")), 1);
  EXPECT_EQ(check().status, 0);
  five();
  EXPECT_EQ(check().status, 0);
}

TEST_F(ApproveCommand, GoldensMayBeHashesWithPicturesOfKeyFrames) {
  five();
  approved();
  limits("keep_every = 2\n");
  approved({"--force"});
  EXPECT_EQ(count_files(at("golden/frames")), 3);
  EXPECT_EQ(Json::parse(golden("hashes.json"))["frames"].size(), 2U);
  Json json = report(0);
  EXPECT_EQ(json["frames"][1]["decided_by"], "hash");
  EXPECT_EQ(json["frames"][2]["decided_by"], "bytes");
  // Other compression of the same pixels is the same picture; another picture is not.
  add_run(1, changed_png("spheres_ref.png", [](double v, std::size_t) { return v; }));
  EXPECT_NE(read_all(at("run/frames/frame_0001.png")), flip_file("spheres_ref.png"));
  EXPECT_EQ(check().status, 0);
  add_run(3, changed_png("spheres_ref.png", [](double v, std::size_t i) { return i == 0 ? v + 1 : v; }));
  EXPECT_EQ(rules(report(1)), Json::parse(R"({"3": ["hash"]})"));
  std::filesystem::remove(at("run/frames/frame_0001.png"));
  EXPECT_EQ(rules(report(1)), Json::parse(R"({"1": ["missing"], "3": ["hash"]})"));
  approved();
  five();
  EXPECT_EQ(rules(report(1)), Json::parse(R"({"3": ["hash"]})"));
  dir_.write("golden/hashes.json", "[]");
  EXPECT_EQ(check().status, 2);
}

TEST_F(ApproveCommand, PlainFoldersKeepTheirNames) {
  dir_.write("run/shot7.png", flip_file("one_b.png"));
  dir_.write("run/shot8.png", flip_file("one_b.png"));
  dir_.write("golden/old_7.png", flip_file("one_a.png"));
  approved();
  EXPECT_EQ(golden("old_7.png"), flip_file("one_b.png"));
  EXPECT_EQ(golden("shot8.png"), flip_file("one_b.png"));
  EXPECT_FALSE(std::filesystem::exists(at("golden/frames")));
}

TEST_F(ApproveCommand, PrunesOnlyOnYes) {
  five();
  approved();
  add_golden(8, flip_file("spheres_ref.png"));
  dir_.write("golden/variants/mac/frames/frame_0009.png", flip_file("spheres_ref.png"));
  add_run(1, flip_file("spheres_moved.png"));
  const std::string out = approved({"--prune"});
  EXPECT_NE(out.find("frame 8: " + at("golden/frames/frame_0008.png").string() + "\nframe 9: "),
            std::string::npos)
      << out;
  EXPECT_NE(out.find("2 stale; --prune --yes deletes them\n"), std::string::npos) << out;
  EXPECT_EQ(count_files(at("golden/frames")), 6);
  approved({"--prune", "--yes"});
  EXPECT_EQ(count_files(at("golden/frames")), 5);
  EXPECT_EQ(count_files(at("golden/variants/mac/frames")), 0);
  EXPECT_EQ(golden("frames/frame_0001.png"), flip_file("spheres_ref.png"));  // nothing is approved by it
  EXPECT_NE(refused({"--yes"}).find("--yes is for --prune"), std::string::npos);
}

TEST_F(ApproveCommand, RunJsonOfPartOfTheFramesKeepsTheOthers) {
  five();
  const auto run_json = [](const char* version, const char* hash) {
    Json frames = Json::array();
    for (int frame = 0; frame < 5; ++frame) frames.push_back({{"frame", frame}, {"picture_sha256", hash}});
    return Json{{"lagomorph", version}, {"frames", frames}}.dump();
  };
  dir_.write("run/run.json", run_json("1", "a"));
  approved();
  dir_.write("run/run.json", run_json("2", "b"));
  add_run(3, flip_file("spheres_moved.png"));
  approved({"--frames", "3"});
  Json json = Json::parse(golden("run.json"));
  EXPECT_EQ(json["lagomorph"], "1");
  EXPECT_EQ(json["frames"][2]["picture_sha256"], "a");
  EXPECT_EQ(json["frames"][3]["picture_sha256"], "b");
  add_run(4, flip_file("spheres_moved.png"));
  approved();
  json = Json::parse(golden("run.json"));
  EXPECT_EQ(json["lagomorph"], "2");
  EXPECT_EQ(json["frames"][2]["picture_sha256"], "a");
  EXPECT_EQ(json["frames"][4]["picture_sha256"], "b");
}

TEST_F(ApproveCommand, AFullDiskLeavesEachFileWhole) {
  five();
  approved();
  for (int frame = 0; frame < 5; ++frame) add_run(frame, flip_file("spheres_moved.png"));
  const Ended ended = approve({}, {.largest_file = 1000});
  EXPECT_EQ(ended.status, 4) << ended.err;
  EXPECT_EQ(count_files(at("golden/frames")), 5);
  for (int frame = 0; frame < 5; ++frame)
    EXPECT_EQ(golden("frames/" + frame_name(frame)), flip_file("spheres_ref.png"));
}

TEST_F(ApproveCommand, Json) {
  five();
  const nlohmann::json json = nlohmann::json::parse(approved({"--json", "--frames", "2..3"}));
  EXPECT_EQ(json["accepted"].size(), 2U);
  EXPECT_EQ(json["accepted"][0]["frame"], 2);
  EXPECT_TRUE(json["accepted"][0]["new"].get<bool>());
}

}  // namespace approve_command_test
}  // namespace lagomorph::tests
