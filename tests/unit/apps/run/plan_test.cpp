#include "apps/run/plan.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/error.h"
#include "tests/support/temporary_directory.h"
#include "tests/unit/apps/run/run_fixture.h"

namespace lagomorph::apps {
namespace plan_test {

namespace fs = std::filesystem;

/// "2:sd" for a frame that is simulated and drawn.
std::string text(const std::vector<FrameJob>& jobs) {
  std::string all;
  for (const FrameJob& job : jobs) {
    all += (all.empty() ? "" : " ") + std::to_string(job.frame) + ":" + (job.simulate ? "s" : "") +
           (job.draw ? "d" : "");
  }
  return all;
}

class Plan : public testing::Test {
protected:
  void SetUp() override { write_run(paths_, 4); }
  std::string missing(int last, std::optional<FrameRange> drawn) const {
    return text(missing_frames(paths_, read_records(paths_), last, drawn));
  }
  tests::TemporaryDirectory dir_;
  RunPaths paths_{dir_.path()};
};

TEST_F(Plan, OfAWholeRunIsEmpty) { EXPECT_EQ(missing(3, FrameRange{0, 3}), ""); }

TEST_F(Plan, GoesOnWhereTheRunEnds) {
  EXPECT_EQ(missing(5, FrameRange{0, 5}), "4:sd 5:sd");
  EXPECT_EQ(missing(5, FrameRange{5, 5}), "4:s 5:sd");
  EXPECT_EQ(missing(5, std::nullopt), "4:s 5:s");
}

TEST_F(Plan, MakesAgainWhatIsNotThere) {
  fs::remove(paths_.picture(1));
  fs::remove(paths_.state(2));
  fs::remove(paths_.record(3));
  EXPECT_EQ(missing(3, FrameRange{0, 3}), "1:d 2:sd 3:sd");
  EXPECT_EQ(missing(3, FrameRange{3, 3}), "2:s 3:sd");
  EXPECT_EQ(missing(2, std::nullopt), "2:s");
}

TEST_F(Plan, MakesAgainWhatHasOtherBytes) {
  write_file(paths_.picture(0), "damaged");
  write_file(paths_.state(1), "");
  write_file(paths_.channel("depth", 2), "damaged");
  EXPECT_EQ(missing(3, FrameRange{0, 3}), "0:d 1:sd 2:d");
}

TEST(WantedFrames, AreAllOrThoseAsked) {
  EXPECT_EQ(wanted_frames(std::nullopt, 5).first, 0);
  EXPECT_EQ(wanted_frames(std::nullopt, 5).last, 4);
  EXPECT_EQ(wanted_frames(FrameRange{2, 4}, 5).first, 2);
  for (const FrameRange wrong : {FrameRange{0, 5}, FrameRange{5, 5}, FrameRange{3, 2}, FrameRange{-1, 2}}) {
    EXPECT_THROW(wanted_frames(wrong, 5), Error) << wrong.first;
  }
  try {
    wanted_frames(FrameRange{3, 200}, 150);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.status, ExitStatus::wrong_input);
    EXPECT_STREQ(error.what(), "--frames 3..200: the scene has frames 0..149");
  }
}

}  // namespace plan_test
}  // namespace lagomorph::apps
