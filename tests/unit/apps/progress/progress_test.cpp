#include "apps/progress/progress.h"

#include <string>

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace progress_test {

std::string said(bool quiet, const auto& what) {
  testing::internal::CaptureStderr();
  {
    Progress progress(quiet);
    what(progress);
  }
  return testing::internal::GetCapturedStderr();
}

TEST(Progress, IsPlainLinesWhereNoTerminalIs) {
  const std::string text = said(false, [](Progress& progress) {
    progress.note("a\nb");
    progress.begin(150);
    for (int i = 0; i < 150; ++i) progress.frame_done();
    progress.end();
  });
  EXPECT_TRUE(text.starts_with("a\\nb\n")) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 11) << "a line at every tenth";
  EXPECT_NE(text.find("\nframe 15 of 150, "), std::string::npos);
  EXPECT_NE(text.find("\nframe 150 of 150, "), std::string::npos);
  EXPECT_EQ(text.find('\r'), std::string::npos);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
}

TEST(Progress, CountsFramesWhateverThePasses) {
  const std::string text = said(false, [](Progress& progress) {
    progress.begin(20, 2);
    for (int i = 0; i < 40; ++i) progress.frame_done();
    progress.end();
  });
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10) << text;
  EXPECT_TRUE(text.starts_with("frame 2 of 20, ")) << text;
  EXPECT_NE(text.find("\nframe 20 of 20, "), std::string::npos);
}

TEST(Progress, NamesAStage) {
  const std::string text = said(false, [](Progress& progress) {
    progress.begin(2, 1, "drawing");
    for (int i = 0; i < 2; ++i) progress.frame_done();
    progress.end();
    progress.begin(1);
    progress.frame_done();
  });
  EXPECT_TRUE(text.starts_with("drawing frame 1 of 2, ")) << text;
  EXPECT_NE(text.find("\ndrawing frame 2 of 2, "), std::string::npos) << text;
  EXPECT_NE(text.find("\nframe 1 of 1, "), std::string::npos) << text;
}

TEST(Progress, IsSilentWhenQuiet) {
  EXPECT_EQ(said(true,
                 [](Progress& progress) {
                   progress.note("a");
                   progress.begin(2);
                   progress.frame_done();
                   progress.frame_done();
                   progress.end();
                 }),
            "");
}

TEST(Progress, Durations) {
  EXPECT_EQ(duration_text(0.0), "0.0 s");
  EXPECT_EQ(duration_text(9.94), "9.9 s");
  EXPECT_EQ(duration_text(12.4), "12 s");
  EXPECT_EQ(duration_text(125.0), "2:05");
  EXPECT_EQ(duration_text(3850.0), "1:04:10");
  EXPECT_EQ(duration_text(-1.0), "0.0 s");
}

}  // namespace progress_test
}  // namespace lagomorph::apps
