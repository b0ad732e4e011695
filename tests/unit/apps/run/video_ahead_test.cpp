#include "apps/run/video_ahead.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/file_io.h"
#include "apps/hash.h"
#include "apps/video/process.h"
#include "render/png.h"
#include "tests/support/run_tree.h"
#include "tests/support/temporary_directory.h"

namespace lagomorph::apps {
namespace video_ahead_test {

namespace fs = std::filesystem;
const auto never = [] { return false; };

class VideoAheadTest : public ::testing::Test {
protected:
  void SetUp() override {
    if (!run_process({"ffmpeg", "-version"}, never).found) GTEST_SKIP() << "ffmpeg is not on the PATH";
    make_folder(paths_.pictures());
    for (int frame = 0; frame < 8; ++frame) draw(frame, 30 * frame);
  }
  /// A picture of one colour, and its record.
  void draw(int frame, int red) {
    render::Picture picture{48, 32, {}};
    for (int i = 0; i < 48 * 32; ++i)
      for (const int value : {red, 200, 100}) picture.rgb.push_back(static_cast<std::uint8_t>(value));
    const std::string png = render::encode_png(picture, 1);
    pictures_[frame] = std::move(picture);
    write_file(paths_.picture(frame), png);
    records_[frame].picture.emplace().sha256 = sha256(png);
  }
  void write(VideoAhead& ahead, int frame) {
    ahead.picture_written(frame, pictures_.at(frame), records_.at(frame).picture->sha256);
  }
  VideoJob job(int first, int last, int every = 1, const std::string& codec = "h264") const {
    return {paths_.pictures(), first, last, 25.0, 48, 32, dir_.path() / "video.mp4", codec, every};
  }
  /// Nothing but the pictures and maybe the video.
  int files() const {
    int count = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(dir_.path()))
      count += entry.is_regular_file();
    return count;
  }

  const tests::TemporaryDirectory dir_;
  const RunPaths paths_{dir_.path()};
  std::map<int, FrameRecord> records_;
  std::map<int, render::Picture> pictures_;
};

TEST_F(VideoAheadTest, HasTheBytesOfAVideoThatIsMadeAfterwards) {
  for (const int every : {1, 3}) {
    for (const char* codec : {"h264", "gif"}) {
      const VideoJob wanted = job(0, 6, every, codec);
      ASSERT_TRUE(make_video(wanted, never));
      const std::string bytes = tests::read_all(wanted.output);
      fs::remove(wanted.output);
      VideoAhead ahead(wanted, paths_, {0, 3});
      for (const int frame : {2, 1, 6, 5, 4}) write(ahead, frame);  // as threads happen to write them
      ASSERT_TRUE(ahead.finish(wanted, records_));
      EXPECT_TRUE(tests::read_all(wanted.output) == bytes) << codec << " " << every;
      EXPECT_EQ(files(), 1);
      fs::remove(wanted.output);
    }
  }
}

/// ffmpeg would take those near 120 a second for that.
TEST_F(VideoAheadTest, HasTheRateThatItShould) {
  for (const double fps : {23.976, 100.1, 119.88, 123.4}) {
    VideoJob wanted = job(0, 5, 1, "prores4444");
    wanted.fps = fps;
    wanted.output = dir_.path() / "video.mov";
    ASSERT_TRUE(make_video(wanted, never));
    const std::string bytes = tests::read_all(wanted.output);
    VideoAhead ahead(wanted, paths_, {0, 1, 2, 3, 4, 5});
    ASSERT_TRUE(ahead.finish(wanted, records_));
    EXPECT_TRUE(tests::read_all(wanted.output) == bytes) << fps;
  }
}

TEST_F(VideoAheadTest, LeavesNothingWhereAPictureIsMissing) {
  VideoAhead ahead(job(0, 4), paths_, {0, 1, 3, 4});
  EXPECT_FALSE(ahead.finish(job(0, 4), records_));
  EXPECT_EQ(files(), 0);
}

TEST_F(VideoAheadTest, LeavesNothingWhereItIsNotWanted) {
  {
    VideoAhead ahead(job(0, 4), paths_, {});
    write(ahead, 0);
  }
  EXPECT_EQ(files(), 0);
}

/// A picture that was drawn again, and more pictures than it began with.
TEST_F(VideoAheadTest, IsNoVideoOfOtherPictures) {
  const std::set<int> all = {0, 1, 2, 3, 4, 5};
  auto ahead = std::make_unique<VideoAhead>(job(0, 4), paths_, all);
  EXPECT_FALSE(ahead->finish(job(0, 5), records_));
  ahead = std::make_unique<VideoAhead>(job(0, 4), paths_, all);
  records_[2].picture->sha256 = "other";
  EXPECT_FALSE(ahead->finish(job(0, 4), records_));
  EXPECT_EQ(files(), 0);
}

TEST_F(VideoAheadTest, TellsNobodyOfAPictureThatIsNotLikeTheOthers) {
  VideoAhead ahead(job(0, 1), paths_, {0});
  ahead.picture_written(1, {8, 8, std::vector<std::uint8_t>(192)}, "other");  // its file is like the others
  EXPECT_TRUE(ahead.finish(job(0, 1), records_));
  write_file(paths_.picture(0), render::encode_png({8, 8, std::vector<std::uint8_t>(192)}, 1));
  VideoAhead of_file(job(0, 1), paths_, {0, 1});
  EXPECT_FALSE(of_file.finish(job(0, 1), records_));
}

TEST_F(VideoAheadTest, TellsNobodyWhenFfmpegFails) {
  VideoJob nowhere = job(0, 4);
  nowhere.output = dir_.path() / "no folder" / "video.mp4";
  VideoAhead ahead(nowhere, paths_, {0, 1, 2, 3, 4});
  EXPECT_FALSE(ahead.finish(nowhere, records_));
  EXPECT_FALSE(fs::exists(nowhere.output));
}

TEST(FedProcess, ReadsWhatItIsFed) {
  const tests::TemporaryDirectory dir;
  const std::string file = (dir.path() / "copy").string(), text(300000, 'x');
  FedProcess copy({"sh", "-c", "cat > " + shell_text({file})});
  EXPECT_TRUE(copy.feed(text));
  EXPECT_TRUE(copy.feed("end"));
  EXPECT_TRUE(copy.finish());
  EXPECT_EQ(tests::read_all(file), text + "end");
}

/// The end of the reader is not ours.
TEST(FedProcess, MayEndBeforeItHasReadAll) {
  const std::string text(300000, 'x');
  FedProcess ends({"sh", "-c", "exit 3"});
  while (ends.feed(text)) {
  }
  EXPECT_FALSE(ends.finish());
  FedProcess missing({"no-such-program-of-lagomorph"});
  EXPECT_FALSE(missing.feed("x"));
  EXPECT_FALSE(missing.finish());
}

TEST(FedProcess, IsEndedWithItsOwner) {
  FedProcess sleeps({"sleep", "600"});  // or this test takes ten minutes
}

}  // namespace video_ahead_test
}  // namespace lagomorph::apps
