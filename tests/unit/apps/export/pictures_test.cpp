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

TEST_F(ExportedPictures, OfARunWithNamesOfItsOwn) {
  expect(0, run("r", {"--pattern", "take.#.png"}));
  expect(0, {"export", at("r").string(), "--format", "png", "--quiet"});
  EXPECT_EQ(read_all(at("r") / "export/bar.0003.png"), read_all(at("r") / "frames/take.3.png"));
}

TEST_F(ExportedPictures, WhatIsWrongIsTold) {
  expect(0, run("r", {"--frames", "0"}));
  const std::string r = at("r").string();
  const auto said = [&](const Arguments& more) { return expect(2, Arguments{"export", r} + more); };
  EXPECT_NE(
      said({"--format", "png", "--frames", "0..1"}).find("frame_0001.png: is not there; lagomorph render"),
      std::string::npos);
  EXPECT_NE(said({"--format", "png", "--fields", "J"}).find("--fields: .png holds no fields"),
            std::string::npos);
  EXPECT_NE(said({"--pattern", "a.#.png"}).find("--pattern: names of --format png"), std::string::npos);
  std::ofstream(at("r") / "frames/frame_0000.png") << "not a picture";
  EXPECT_NE(said({"--format", "png"}).find("frame_0000.png: is not what its record tells"),
            std::string::npos);
}

}  // namespace pictures_test
}  // namespace lagomorph::tests
