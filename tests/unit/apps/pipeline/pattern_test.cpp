#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/unit/apps/pipeline/run_fixture.h"

/// Pictures with names of their own: run and render --pattern.
namespace lagomorph::tests {
namespace pattern_test {

namespace fs = std::filesystem;

class Pattern : public ProgramRun {
protected:
  const Arguments shots_ = {"--pattern", "take2_###_v3.png"};
  static Arguments frames(const char* range) { return {"--frames", range}; }
};

TEST_F(Pattern, NamesPicturesAndTheirChannelsAlone) {
  backend_ = "raster";
  expect(0, run("usual"));
  expect(0, run("r", shots_));
  EXPECT_EQ(count_files(at("r") / "frames"), 4);
  EXPECT_EQ(read_all(at("r") / "frames/take2_002_v3.png"), read_all(at("usual") / "frames/frame_0002.png"));
  EXPECT_EQ(read_all(at("r") / "aov/depth/take2_002_v3.npy"),
            read_all(at("usual") / "aov/depth/frame_0002.npy"));
  EXPECT_TRUE(fs::exists(at("r") / "states/frame_0002.npy"));
  EXPECT_EQ(run_json("r").at("pattern"), "take2_###_v3.png");
  EXPECT_FALSE(run_json("usual").contains("pattern"));
}

TEST_F(Pattern, IsKeptByWhatGoesOn) {
  expect(0, run("whole", shots_));
  expect(0, run("r", shots_ + frames("0..1")));
  expect(0, run("r"));
  expect_same_run(at("whole"), at("r"));
  fs::remove(at("r") / "frames/take2_001_v3.png");
  expect(0, render("r"));
  expect_same_run(at("whole"), at("r"));
  const Ended info = run_program({"info", at("r").string(), "--json"});
  EXPECT_EQ(nlohmann::json::parse(info.out).at("pictures"), (std::vector<int>{0, 1, 2, 3}));
  expect(0, simulate("states"));
  expect(0, render("states", shots_));
  EXPECT_TRUE(fs::exists(at("states") / "frames/take2_003_v3.png"));
  expect(0, render("states", {"--set", "camera.fov=20", "-o", at("look").string()}));
  EXPECT_TRUE(fs::exists(at("look") / "frames/frame_0003.png")) << "a run of its own";
}

TEST_F(Pattern, AnotherIsRefused) {
  expect(0, run("r"));
  EXPECT_NE(expect(2, run("r", shots_))
                .find("is another run: --pattern frame_####.png -> take2_###_v3.png; --force makes anew what "
                      "does not "
                      "match (4 pictures)"),
            std::string::npos);
  EXPECT_NE(expect(2, render("r", shots_)).find("is another run: --pattern"), std::string::npos);
  EXPECT_EQ(count_files(at("r") / "frames"), 4);
  expect(0, render("r", shots_ + Arguments{"--force"}));
  EXPECT_EQ(count_files(at("r") / "frames"), 4);
  EXPECT_TRUE(fs::exists(at("r") / "frames/take2_003_v3.png"));
  expect(0, run("whole", shots_));
  expect_same_run(at("whole"), at("r"));
  EXPECT_NE(
      expect(2, run("other", {"--pattern", "shot.png"})).find("--pattern shot.png: must be a plain name"),
      std::string::npos);
  EXPECT_FALSE(fs::exists(at("other")));
}

TEST_F(Pattern, IsFoundByCheckApproveAndPreview) {
  expect(0, run("r", shots_));
  const std::string r = at("r").string(), golden = at("golden").string();
  expect(0, {"approve", r, golden, "--quiet"});
  EXPECT_TRUE(fs::exists(at("golden") / "frames/frame_0003.png"));
  expect(0, {"check", r, golden, "--quiet"});
  expect(0, run("usual"));
  expect(0, {"check", at("usual").string(), golden, "--quiet"});
  fs::remove(at("r") / "frames/take2_003_v3.png");
  EXPECT_EQ(run_program({"check", r, golden, "--quiet"}).status, 1) << "frame 3 is missing";
  expect(0, {"preview", r, "--quiet"});
  EXPECT_TRUE(fs::exists(at("r") / "preview/contact_sheet.png"));
}

TEST_F(Pattern, VideosAreMadeOfThem) {
  const Ended whole = run_program(run("usual", {"--video"}));
  if (whole.status == 4) GTEST_SKIP() << "ffmpeg is not on the PATH";
  expect(0, run("r", {"--pattern", "10%#%.png", "--video"}));
  EXPECT_EQ(read_all(at("r") / "bar.mp4"), read_all(at("usual") / "bar.mp4"));
  expect(0, run("every", shots_ + Arguments{"--every", "2", "--codec", "gif"}));
  EXPECT_TRUE(fs::exists(at("every") / "bar.gif"));
}

}  // namespace pattern_test
}  // namespace lagomorph::tests
