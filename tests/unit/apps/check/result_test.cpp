#include "apps/check/result.h"

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace result_test {

FrameResult frame(int number, std::optional<double> tile, bool passes) {
  FrameResult result;
  result.frame = number;
  if (tile) {
    result.figures.emplace();
    result.figures->flip_tile.mean = *tile;
  }
  if (!passes) result.failures.push_back({"flip_tile_max", "0.3", "0.12", "preset render"});
  return result;
}

TEST(CheckResult, AFailureTellsRuleFigureLimitAndWhoSaysSo) {
  EXPECT_EQ((CheckFailure{"flip_mean", "0.07", "0.05", "golden.toml:4:13"}.line()),
            "flip_mean 0.07, limit 0.05 by golden.toml:4:13");
  EXPECT_EQ((CheckFailure{"missing", "in RUN", "", ""}.line()), "missing in RUN");
}

TEST(CheckResult, CountsAndSortsTheFailingFrames) {
  CheckResult result;
  result.run = "out/a b";
  result.golden = "golden/a";
  result.frames = {frame(0, 0.9, true), frame(1, 0.2, false), frame(2, 0.5, false), frame(3, {}, false)};
  EXPECT_EQ(result.failed(), 3);
  EXPECT_FALSE(result.passed());
  const auto worst = worst_first(result);
  ASSERT_EQ(worst.size(), 3U);
  EXPECT_EQ(worst[0]->frame, 3);
  EXPECT_EQ(worst[1]->frame, 2);
  EXPECT_EQ(worst[2]->frame, 1);
  EXPECT_EQ(frame_commands(result, 2).approve, "lagomorph approve 'out/a b' golden/a --frames 2");
}

}  // namespace result_test
}  // namespace lagomorph::apps
