#include "apps/frame_names.h"

#include <string>

#include <gtest/gtest.h>

#include "apps/error.h"

namespace lagomorph::apps {
namespace frame_names_test {

TEST(FrameNames, PadTheNumber) {
  EXPECT_EQ(FrameNames("a.####.png").file(7, ".png"), "a.0007.png");
  EXPECT_EQ(FrameNames("a.####.png").file(7, ".exr"), "a.0007.exr");
  EXPECT_EQ(FrameNames("#.png").file(12345, ".png"), "12345.png");
  EXPECT_EQ(FrameNames("a#b##c2.png").file(3, ".png"), "a#b03c2.png");
  EXPECT_EQ(FrameNames().file(12, ".png"), "frame_0012.png");
  EXPECT_EQ(FrameNames("frame_####.png"), FrameNames());
  EXPECT_EQ(FrameNames("a#b##c2.png").pattern(), "a#b##c2.png");
}

TEST(FrameNames, AreReadBack) {
  for (const char* pattern : {"a.####.png", "#.png", "9#.png", "take2_###_v3.png", "frame_####.png"}) {
    const FrameNames names(pattern);
    for (const int frame : {0, 7, 999, 123456}) {
      EXPECT_EQ(names.frame_of("x/" + names.file(frame, ".png"), ".png"), frame) << pattern;
      EXPECT_EQ(names.frame_of(names.file(frame, ".npy"), ".png"), std::nullopt) << pattern;
    }
  }
  const FrameNames names("a.##b.png");
  for (const char* other : {"a.1b.png", "a.001b.png", "a.01.png", "a.b.png", "b.01b.png", "a.-1b.png",
                            "a.png", ".a.01b.png", "", "a.99999999999b.png"})
    EXPECT_EQ(names.frame_of(other, ".png"), std::nullopt) << other;
}

TEST(FrameNames, AreTakenByPrintf) {
  EXPECT_EQ(FrameNames("a.####.png").printf_format(), "a.%04d");
  EXPECT_EQ(FrameNames("100%#%.png").printf_format(), "100%%%01d%%");
}

TEST(FrameNames, WhatIsNoneIsTold) {
  for (const char* const wrong : {"", "a.png", "a.###", "x/a.#.png", ".#.png", "#.jpg", "a|#.png", "a\n#.png",
                                  "#################.png"}) {
    try {
      FrameNames{std::string(wrong)};
      ADD_FAILURE() << wrong;
    } catch (const Error& error) {
      EXPECT_EQ(error.status, ExitStatus::wrong_input);
      EXPECT_EQ(std::string(error.what()).find(std::string("--pattern ") + wrong + ": must be a plain name"),
                0U)
          << error.what();
    }
  }
}

}  // namespace frame_names_test
}  // namespace lagomorph::apps
