#include "apps/export/pictures.h"

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/unit/apps/pipeline/run_fixture.h"

namespace lagomorph::tests {
namespace pictures_test {

class ExportedPictures : public ProgramRun {};

TEST_F(ExportedPictures, HaveTheNamesOfAPattern) {
  expect(0, run("r"));
  const std::string r = at("r").string(), out = at("shots").string();
  expect(0, {"export", r, "--format", "png", "--pattern", "shot.###.png", "--frames", "1..2", "-o", out,
             "--quiet"});
  EXPECT_EQ(count_files(out), 2);
  EXPECT_EQ(read_all(at("shots") / "shot.002.png"), read_all(at("r") / "frames/frame_0002.png"));
  expect(0, {"export", r, "--format", "png", "--quiet"});
  EXPECT_EQ(count_files(at("r") / "export"), 4);
  EXPECT_EQ(read_all(at("r") / "export/bar.0003.png"), read_all(at("r") / "frames/frame_0003.png"));
}

TEST_F(ExportedPictures, WhatIsWrongIsTold) {
  expect(0, run("r", {"--frames", "0"}));
  const std::string r = at("r").string();
  const auto said = [&](const Arguments& more) { return expect(2, Arguments{"export", r} + more); };
  EXPECT_NE(
      said({"--format", "png", "--frames", "0..1"}).find("frame_0001.png: is not there; lagomorph render"),
      std::string::npos);
  EXPECT_NE(
      said({"--format", "png", "--pattern", "shot.png"}).find("--pattern shot.png: must be a plain name"),
      std::string::npos);
  EXPECT_NE(said({"--format", "png", "--fields", "J"}).find("--fields: .png holds no fields"),
            std::string::npos);
  EXPECT_NE(said({"--pattern", "a.#.png"}).find("--pattern: names of --format png"), std::string::npos);
  std::ofstream(at("r") / "frames/frame_0000.png") << "not a picture";
  EXPECT_NE(said({"--format", "png"}).find("frame_0000.png: is not what its record tells"),
            std::string::npos);
}

TEST(PictureName, PadsTheNumber) {
  EXPECT_EQ(apps::picture_name("a.####.png", 7), "a.0007.png");
  EXPECT_EQ(apps::picture_name("#.png", 12345), "12345.png");
  EXPECT_EQ(apps::picture_name("a#b##.png", 3), "a#b03.png");
  for (const char* const wrong : {"a.png", "a.###", "x/a.#.png", ".#.png", "#.jpg"})
    EXPECT_THROW(apps::picture_name(wrong, 0), apps::Error) << wrong;
}

}  // namespace pictures_test
}  // namespace lagomorph::tests
