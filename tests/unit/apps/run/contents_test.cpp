#include "apps/run/contents.h"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "apps/error.h"
#include "tests/support/run_tree.h"
#include "tests/support/temporary_directory.h"
#include "tests/unit/apps/run/run_fixture.h"

namespace lagomorph::apps {
namespace contents_test {

namespace fs = std::filesystem;

std::string refusal(const RunPaths& paths, const Identity& wanted) {
  try {
    refuse_others(paths, read_contents(paths, wanted), wanted);
  } catch (const Error& error) {
    EXPECT_EQ(error.status, ExitStatus::wrong_input);
    return std::string(error.what()).substr(paths.root().string().size());
  }
  return "";
}

TEST(RunContents, OfNoFolderAreEmpty) {
  const tests::TemporaryDirectory dir;
  const RunContents contents = read_contents(RunPaths(dir.path() / "missing"), some_identity());
  EXPECT_FALSE(contents.info.has_value());
  EXPECT_TRUE(contents.matching.empty());
}

TEST(RunContents, MatchByWhatMadeThem) {
  const tests::TemporaryDirectory dir;
  const RunPaths paths(dir.path());
  write_run(paths, 3);
  const RunContents same = read_contents(paths, some_identity());
  EXPECT_EQ(same.matching.size(), 3U);
  EXPECT_EQ(same.other_states + same.other_pictures, 0);
  EXPECT_TRUE(same.matching.at(1).picture.has_value());

  const RunContents look = read_contents(paths, some_identity("1000.0", "20.0"));
  EXPECT_EQ(look.matching.size(), 3U);
  EXPECT_FALSE(look.matching.at(1).picture.has_value());
  EXPECT_EQ(look.other_states, 0);
  EXPECT_EQ(look.other_pictures, 3);

  const RunContents physics = read_contents(paths, some_identity("999.0"));
  EXPECT_TRUE(physics.matching.empty());
  EXPECT_EQ(physics.other_states, 3);
}

TEST(RunContents, APictureOfAnotherStateDoesNotMatch) {
  const tests::TemporaryDirectory dir;
  const RunPaths paths(dir.path());
  write_run(paths, 1);
  FrameRecord record = some_record(0);
  record.picture->of_state = sha256("another");
  write_frame(paths, record);
  EXPECT_FALSE(read_contents(paths, some_identity()).matching.at(0).picture.has_value());
}

TEST(RunContents, OfAnotherRunAreRefusedByTheKeys) {
  const tests::TemporaryDirectory dir;
  const RunPaths paths(dir.path());
  write_run(paths, 2);
  EXPECT_EQ(refusal(paths, some_identity()), "");
  EXPECT_EQ(refusal(paths, some_identity("999.0")),
            ": is another run: body.0.density 1000.0 -> 999.0; --force makes anew what does not match (2 "
            "states and "
            "their pictures), --out writes elsewhere");
  EXPECT_EQ(
      refusal(paths, some_identity("1000.0", "20.0")),
      ": is another run: camera.fov 35.0 -> 20.0; --force makes anew what does not match (2 pictures), --out "
      "writes elsewhere");
  EXPECT_NE(refusal(paths, some_identity("1000.0", "35.0", "\"b\"")).find("build.program \"a\" -> \"b\""),
            std::string::npos);
}

TEST(RunContents, WithoutPicturesAnyLookIsFree) {
  const tests::TemporaryDirectory dir;
  const RunPaths paths(dir.path());
  write_run(paths, 0);
  EXPECT_EQ(refusal(paths, some_identity("999.0")), "");
  write_frame(paths, some_record(0, some_identity(), false));
  EXPECT_EQ(refusal(paths, some_identity("1000.0", "20.0")), "");
  EXPECT_NE(refusal(paths, some_identity("999.0")), "");
}

TEST(RunContents, WhatAKilledForceLeftIsNoReason) {
  const tests::TemporaryDirectory dir;
  const RunPaths paths(dir.path());
  write_run(paths, 3, some_identity("1.0"));
  RunInfo info;
  info.identity = some_identity();
  write_file(paths.run_json(), run_json_text(info, {}));
  EXPECT_EQ(refusal(paths, some_identity()), "");
}

TEST(RunContents, WithoutRunJsonOthersAreRefused) {
  const tests::TemporaryDirectory dir;
  const RunPaths paths(dir.path());
  write_run(paths, 2);
  fs::remove(paths.run_json());
  EXPECT_EQ(refusal(paths, some_identity()), "");
  EXPECT_NE(refusal(paths, some_identity("999.0")).find("its run.json is missing"), std::string::npos);
}

TEST(RunContents, FoldersOfOthersAreNotTouched) {
  for (const char* name :
       {"scene.toml", "frames/frame_0000.png", "states/x", "energy.csv", "mesh.msh", "inputs/a"}) {
    const tests::TemporaryDirectory dir;
    dir.write(name, "mine");
    try {
      read_contents(RunPaths(dir.path()), some_identity());
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.status, ExitStatus::wrong_input);
      EXPECT_NE(std::string(error.what()).find("is no run (it has no run.json)"), std::string::npos)
          << error.what();
    }
  }
  const tests::TemporaryDirectory dir;
  dir.write("notes.txt", "mine");
  EXPECT_NO_THROW(read_contents(RunPaths(dir.path()), some_identity()));
  EXPECT_THROW(read_contents(RunPaths(dir.path() / "notes.txt"), some_identity()), Error);
}

TEST(RunContents, ADamagedRunJsonIsTold) {
  const tests::TemporaryDirectory dir;
  const RunPaths paths(dir.path());
  for (const char* text : {"", "{", "[]", "{\"keys\": 3}"}) {
    dir.write("run.json", text);
    EXPECT_THROW(read_contents(paths, some_identity()), Error) << text;
  }
}

TEST(RunContents, RemovesWhatDoesNotMatchAndWhatWasLeft) {
  const tests::TemporaryDirectory dir;
  const RunPaths paths(dir.path());
  write_run(paths, 3);
  write_frame(paths, some_record(1, some_identity("999.0")));           // another simulation
  write_frame(paths, some_record(2, some_identity("1000.0", "20.0")));  // another look
  dir.write("states/frame_0007.npy", "no record");
  dir.write("frames/frame_0007.png", "no record");
  dir.write("aov/depth/frame_0007.npy", "no record");
  dir.write("states/.frame_0008.npy.12.tmp", "half");
  dir.write(".run.json.12.tmp", "half");
  dir.write("frames/notes.txt", "mine");
  remove_unmatched(paths, read_contents(paths, some_identity()));
  const auto files = tests::tree(dir.path());
  for (const char* gone : {"states/frame_0001.npy", "frames/frame_0001.png", "records/frame_0001.json",
                           "aov/depth/frame_0001.npy", "frames/frame_0002.png", "aov/depth/frame_0002.npy",
                           "states/frame_0007.npy", "frames/frame_0007.png", "aov/depth/frame_0007.npy",
                           "states/.frame_0008.npy.12.tmp", ".run.json.12.tmp"}) {
    EXPECT_FALSE(files.contains(gone)) << gone;
  }
  for (const char* kept : {"states/frame_0000.npy", "frames/frame_0000.png", "records/frame_0000.json",
                           "aov/depth/frame_0000.npy", "states/frame_0002.npy", "records/frame_0002.json",
                           "frames/notes.txt", "run.json"}) {
    EXPECT_TRUE(files.contains(kept)) << kept;
  }
  const auto records = read_records(paths);
  EXPECT_TRUE(records.at(0).picture.has_value());
  EXPECT_FALSE(records.at(2).picture.has_value());
}

}  // namespace contents_test
}  // namespace lagomorph::apps
