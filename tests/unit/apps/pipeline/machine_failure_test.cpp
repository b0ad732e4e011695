#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

#include "tests/unit/apps/pipeline/run_fixture.h"

/// What the machine may fail in: status 4, what was made is kept, the same command goes on.
namespace lagomorph::tests {
namespace machine_failure_test {

namespace fs = std::filesystem;

class MachineFailure : public ProgramRun {};

/// A small file system of its own, where the test may mount one.
class SmallDisk {
public:
  SmallDisk(const fs::path& place, const std::string& options) : place_(place) {
    fs::create_directories(place);
    mounted_ = ::mount("tmpfs", place.c_str(), "tmpfs", 0, options.c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) ::umount(place_.c_str());
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool is_there() const { return mounted_; }
  bool make_read_only() const { return ::mount("", place_.c_str(), "", MS_REMOUNT | MS_RDONLY, "") == 0; }

private:
  fs::path place_;
  bool mounted_ = false;
};

TEST_F(MachineFailure, AFileThatCannotGrowEndsTheRun) {
  // States of the bar have 3 kB, its records 1 kB, its mesh 9 kB: the depth channel's 12 kB are what fails.
  const std::string said = expect(4, run("r"), {.largest_file = 11000});
  EXPECT_NE(said.find("aov/depth/frame_000"), std::string::npos) << said;
  EXPECT_NE(said.find("cannot be written: File too large"), std::string::npos) << said;
  for (const auto& [name, contents] : tree(at("r"))) EXPECT_FALSE(name.ends_with(".tmp")) << name;
  expect(0, run("r"));
  expect(0, run("whole"));
  expect_same_run(at("whole"), at("r"));
}

TEST_F(MachineFailure, ADiskThatFillsUpEndsTheRun) {
  const SmallDisk disk(at("disk"), "size=120k");
  if (!disk.is_there()) GTEST_SKIP() << "no file system can be mounted here";
  const std::string said =
      expect(4, run("disk/r", {"--set", "time.frames=9", "--set", "render.channels=[]"}));
  EXPECT_NE(said.find("cannot be written: No space left on device"), std::string::npos) << said;
  for (const auto& [name, contents] : tree(at("disk"))) EXPECT_FALSE(name.ends_with(".tmp")) << name;
}

TEST_F(MachineFailure, TooLittleSpaceIsToldBeforeAnythingIsWritten) {
  const SmallDisk disk(at("disk"), "size=200k");
  if (!disk.is_there()) GTEST_SKIP() << "no file system can be mounted here";
  const std::string said = expect(4, run("disk/r", {"--set", "time.frames=1000"}));
  EXPECT_NE(said.find("are free on its disk; the run takes at least "), std::string::npos) << said;
  EXPECT_TRUE(fs::is_empty(at("disk")));
}

TEST_F(MachineFailure, AReadOnlyDiskIsTold) {
  const SmallDisk disk(at("disk"), "size=8m");
  if (!disk.is_there()) GTEST_SKIP() << "no file system can be mounted here";
  expect(0, run("disk/r"));
  ASSERT_TRUE(disk.make_read_only());
  expect(0, run("disk/r"));  // nothing to do, and nothing is written
  EXPECT_NE(expect(4, run("disk/other")).find("Read-only file system"), std::string::npos);
  EXPECT_NE(expect(4, run("disk/r", {"--set", "time.frames=5"})).find("Read-only file system"),
            std::string::npos);
}

TEST_F(MachineFailure, AFolderWithoutPermissionIsTold) {
  constexpr uid_t nobody = 65534;  // root may write everywhere
  fs::create_directories(at("locked"));
  fs::permissions(at("locked"), fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                                    fs::perms::others_exec);
  const ProgramOptions options{.user = ::geteuid() == 0 ? std::optional(nobody) : std::nullopt};
  if (run_program({"--version"}, options).status != 0) GTEST_SKIP() << "nobody cannot reach the program";
  EXPECT_NE(expect(4, run("locked/r"), options).find("Permission denied"), std::string::npos);
}

TEST_F(MachineFailure, WithoutFfmpegThePicturesAreKept) {
  const std::string said = expect(4, run("r", {"--video"}), {.environment = {{"PATH", "/nowhere"}}});
  EXPECT_NE(said.find("ffmpeg is not on the PATH"), std::string::npos) << said;
  EXPECT_NE(said.find("make the video later with: ffmpeg "), std::string::npos) << said;
  EXPECT_EQ(count_files(at("r") / "frames"), 4);
  EXPECT_EQ(run_json("r").at("frames").size(), 4U);

  const std::string later = said.substr(said.find("ffmpeg -"));
  if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "ffmpeg is not on the PATH";
  EXPECT_EQ(std::system(later.c_str()), 0) << later;
  EXPECT_TRUE(fs::exists(at("r") / "bar.mp4"));
}

TEST_F(MachineFailure, TheVideoIsMadeOnceAndWhenPicturesChange) {
  if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "ffmpeg is not on the PATH";
  expect(0, run("r", {"--video"}));
  const std::string video = read_all(at("r") / "bar.mp4");
  const auto made = fs::last_write_time(at("r") / "bar.mp4");
  EXPECT_EQ(run_json("r").at("video").at("file"), "bar.mp4");
  expect(0, run("r", {"--video"}));
  expect(0, run("r"));
  EXPECT_EQ(fs::last_write_time(at("r") / "bar.mp4"), made);
  fs::remove(at("r") / "bar.mp4");
  expect(0, run("r", {"--video"}));
  EXPECT_EQ(read_all(at("r") / "bar.mp4"), video);
  expect(0, run("r", {"--video", "--set", "name=beam"}));
  EXPECT_FALSE(fs::exists(at("r") / "bar.mp4"));
  EXPECT_EQ(read_all(at("r") / "beam.mp4"), video);
  expect(0, run("r", {"--force", "--backend", "raster"}));
  EXPECT_FALSE(fs::exists(at("r") / "beam.mp4")) << "a video of pictures that are gone";
}

TEST_F(MachineFailure, TheVideoOfShardsIsThatOfTheWhole) {
  if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "ffmpeg is not on the PATH";
  expect(0, run("whole", {"--video"}));
  expect(0, run("r", {"--video", "--frames", "0..1"}));
  EXPECT_EQ(run_json("r").at("video").at("last"), 1);
  expect(0, run("r", {"--video", "--frames", "2..3"}));
  expect_same_run(at("whole"), at("r"));
}

}  // namespace machine_failure_test
}  // namespace lagomorph::tests
