#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/check_fixture.h"
#include "tests/support/paths.h"

/// `lagomorph check` of the project's own goldens: pictures of committed states (tests/golden/states) against
/// committed pictures (tests/golden/<case>), so that physics cannot move them.
namespace lagomorph::tests {
namespace golden_test {

namespace fs = std::filesystem;

const fs::path goldens = lagomorph::tests::source_dir() / "tests/golden";

class Golden : public testing::TestWithParam<std::string> {
protected:
  fs::path golden() const { return goldens / ("bunny_" + GetParam()); }
  /// Draws frames of the committed states with other scene keys.
  fs::path draw(const std::string& frames, std::vector<std::string> more = {}) const {
    const fs::path run = dir_.path() / "run";
    std::vector<std::string> arguments = {"render",    (goldens / "states").string(),
                                          "--backend", GetParam(),
                                          "--frames",  frames,
                                          "--out",     run.string(),
                                          "--quiet",   "--force"};
    for (const std::string& set : more) arguments.insert(arguments.end(), {"--set", set});
    const Ended ended = run_program(arguments);
    EXPECT_EQ(ended.status, 0) << ended.err;
    return run;
  }
  Ended check(const fs::path& run, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"check", run.string(), golden().string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments);
  }
  TemporaryDirectory dir_;
};

TEST_P(Golden, PicturesOfCommittedStatesAreTheCommittedOnes) {
  draw("2");
  const Ended ended = check(draw("4"));
  EXPECT_EQ(ended.status, 0) << ended.out << ended.err;
}

// A golden that every picture passes is none: the other frame and the other back end's picture are refused.
TEST_P(Golden, OtherPicturesFail) {
  const std::string other = GetParam() == "raster" ? "path" : "raster";
  dir_.write("late/frame_0002.png", read_all(golden() / "frames/frame_0004.png"));
  dir_.write("late/frame_0004.png", read_all(golden() / "frames/frame_0004.png"));
  const Ended late = check(dir_.path() / "late");
  EXPECT_EQ(late.status, 1) << late.err;
  EXPECT_NE(late.out.find("matches the golden's frame + 2 in frame 2\n"), std::string::npos) << late.out;
  EXPECT_EQ(check(goldens / ("bunny_" + other), {"-o", (dir_.path() / "report").string()}).status, 1);
}

// What nobody sees passes by the defaults, and what one looks for fails.
TEST_P(Golden, DefaultsSortOtherLooks) {
  const bool raster = GetParam() == "raster";
  const auto status = [&](const std::vector<std::string>& set) {
    return check(draw("2", set), {"--frames", "2", "--preset", "render"}).status;
  };
  EXPECT_EQ(status({raster ? "render.raster.multisample=1" : "render.path.seed=7"}), 0);
  if (!raster) {
    EXPECT_EQ(status({"render.samples=256"}), 0);
    EXPECT_EQ(status({"render.samples=16", "render.path.seed=3"}), 0);  // Sobol's noise is small
  }
  EXPECT_EQ(status({"ground.enabled=false"}), 1);                     // a missing object
  EXPECT_EQ(status({"camera.look_at=[-0.1, 0.98, 0]"}), 1);           // a moved one
  EXPECT_EQ(status({"light.0.color=[1, 0.9, 0.6]"}), 1);              // a cast
  EXPECT_EQ(status({"body.0.look.base_color=[0.1, 0.3, 0.42]"}), 1);  // another colour
  EXPECT_EQ(status({"render.exposure=0.15"}), 1);                     // brightness
}

INSTANTIATE_TEST_SUITE_P(Cases, Golden, testing::Values("raster", "path"),
                         [](const auto& info) { return info.param; });

}  // namespace golden_test
}  // namespace lagomorph::tests
