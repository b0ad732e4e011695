#include "apps/video/video.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/run/paths.h"
#include "apps/video/process.h"
#include "render/color.h"
#include "render/png.h"
#include "tests/support/program.h"
#include "tests/support/run_tree.h"
#include "tests/support/temporary_directory.h"

namespace lagomorph::apps {
namespace video_test {

namespace fs = std::filesystem;
const auto never = [] { return false; };

bool has_ffmpeg() { return run_process({"ffmpeg", "-version"}, never).found; }

/// Pictures first..last, each of one colour that tells its number.
VideoJob job_of(const tests::TemporaryDirectory& dir, const std::string& folder, int first, int last,
                int width, int height) {
  make_folder(dir.path() / folder);
  for (int frame = first; frame <= last; ++frame) {
    render::Picture picture{width, height, {}};
    for (int i = 0; i < width * height; ++i) {
      for (const int value : {40 * frame, 200, 100}) picture.rgb.push_back(static_cast<std::uint8_t>(value));
    }
    write_file(dir.path() / folder / frame_file(frame, ".png"), render::encode_png(picture, 1));
  }
  return {dir.path() / folder, first, last, 12.5, width, height, dir.path() / "video.mp4"};
}

/// What ffprobe says of the video, as one text of key=value words.
std::string probe(const fs::path& video, const fs::path& folder) {
  const fs::path out = folder / "probe";
  const std::string keys =
      "stream=codec_name,pix_fmt,width,height,nb_frames,r_frame_rate,color_space,color_range";
  run_process(
      {"sh", "-c",
       shell_text({"ffprobe", "-v", "error", "-show_entries", keys, "-of", "default=nw=1", video.string()}) +
           " > " + shell_text({out.string()})},
      never);
  std::string text = tests::read_all(out);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

TEST(Video, IsWhatPlayersTake) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not on the PATH";
  const tests::TemporaryDirectory dir;
  const VideoJob job = job_of(dir, "frames", 2, 5, 64, 48);
  ASSERT_TRUE(make_video(job, never));
  const std::string text = probe(job.output, dir.path());
  for (const char* fact : {"codec_name=h264", "pix_fmt=yuv420p", "width=64", "height=48", "nb_frames=4",
                           "r_frame_rate=25/2", "color_space=bt709", "color_range=tv"}) {
    EXPECT_NE(text.find(fact), std::string::npos) << fact << " is not in " << text;
  }
  const std::string bytes = tests::read_all(job.output);
  EXPECT_LT(bytes.find("moov"), bytes.find("mdat")) << "faststart";
  ASSERT_TRUE(make_video(job, never));
  EXPECT_TRUE(tests::read_all(job.output) == bytes) << "the same pictures give the same bytes";
  EXPECT_EQ(tests::count_files(dir.path()), 2) << "nothing is left beside the video and the probe's text";
}

TEST(Video, HasOtherCodecs) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not on the PATH";
  const tests::TemporaryDirectory dir;
  VideoJob job = job_of(dir, "frames", 2, 5, 64, 48);
  for (const auto& [codec, name, format] :
       {std::tuple("h264", "h264", "yuv420p"), std::tuple("h265", "hevc", "yuv420p"),
        std::tuple("vp9", "vp9", "yuv420p"), std::tuple("prores", "prores", "yuv422p10le")}) {
    job.codec = codec;
    job.output = dir.path() / ("video" + video_extension(codec));
    ASSERT_TRUE(make_video(job, never));
    const std::string text = probe(job.output, dir.path());
    EXPECT_NE(text.find("codec_name=" + std::string(name) + " "), std::string::npos) << text;
    EXPECT_NE(text.find("pix_fmt=" + std::string(format) + " "), std::string::npos) << text;
    EXPECT_NE(text.find("r_frame_rate=25/2"), std::string::npos) << text;
    const std::string bytes = tests::read_all(job.output);
    ASSERT_TRUE(make_video(job, never));
    EXPECT_TRUE(tests::read_all(job.output) == bytes) << codec << ": the same pictures give the same bytes";
  }
  EXPECT_THROW(video_extension("divx"), Error);
}

/// Animated pictures that repeat for ever; of the GIF the palette is the pictures' own.
TEST(Video, CanBeAnAnimatedPicture) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not on the PATH";
  const tests::TemporaryDirectory dir;
  VideoJob job = job_of(dir, "frames", 2, 5, 33, 25);
  for (const char* const codec : {"webp", "gif"}) {
    job.codec = codec;
    job.output = dir.path() / ("video" + video_extension(codec));
    ASSERT_TRUE(make_video(job, never));
    const std::string bytes = tests::read_all(job.output);
    ASSERT_TRUE(make_video(job, never));
    EXPECT_TRUE(tests::read_all(job.output) == bytes) << codec << ": the same pictures give the same bytes";
  }
  const std::string webp = tests::read_all(dir.path() / "video.webp"),
                    gif = tests::read_all(dir.path() / "video.gif");
  const auto count = [](const std::string& text, const std::string& word) {
    int n = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count(webp, "ANMF"), 4);
  EXPECT_NE(gif.find("NETSCAPE2.0"), std::string::npos) << "repeats";
  const std::string text = probe(dir.path() / "video.gif", dir.path());
  for (const char* fact : {"codec_name=gif", "width=33", "height=25"})
    EXPECT_NE(text.find(fact), std::string::npos) << text;
  const fs::path raw = dir.path() / "raw";
  run_process({"ffmpeg", "-v", "error", "-i", (dir.path() / "video.gif").string(), "-f", "rawvideo",
               "-pix_fmt", "rgb24", raw.string()},
              never);
  const std::string pixels = tests::read_all(raw);
  ASSERT_EQ(pixels.size(), std::size_t{4 * 33 * 25 * 3});
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(static_cast<unsigned char>(pixels[i * 33 * 25 * 3]), 40 * (2 + i)) << "exactly its colour";
}

/// No delay of 1/100 s, which players take for ten.
TEST(Video, AsGifHasNoMoreThanFiftyPicturesASecond) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not on the PATH";
  const tests::TemporaryDirectory dir;
  VideoJob job = job_of(dir, "frames", 0, 5, 8, 8);
  job.fps = 60.0;
  job.codec = "gif";
  job.output = dir.path() / "video.gif";
  ASSERT_TRUE(make_video(job, never));
  const std::string gif = tests::read_all(job.output), control = {'\x21', '\xf9', '\x04'};
  int pictures = 0;
  for (std::size_t at = gif.find(control); at != std::string::npos;
       at = gif.find(control, at + 1), ++pictures)
    EXPECT_GE(gif[at + 4] + 256 * gif[at + 5], 2);
  EXPECT_EQ(pictures, 5);
  EXPECT_EQ(rate_remark("gif", 60.0), "gif has 50 pictures a second at most: some of 60 are left out");
  EXPECT_EQ(rate_remark("gif", 50.0), "");
  EXPECT_EQ(rate_remark("h264", 240.0), "");
}

/// Frames of ProRes tell their tables themselves, and other programs go by them.
TEST(Video, AsProResTellsItsColours) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not on the PATH";
  const tests::TemporaryDirectory dir;
  VideoJob job = job_of(dir, "frames", 0, 1, 32, 16);
  for (const char* codec : {"prores", "prores4444"}) {
    job.codec = codec;
    job.output = dir.path() / "video.mov";
    ASSERT_TRUE(make_video(job, never));
    EXPECT_NE(probe(job.output, dir.path()).find("color_space=bt709"), std::string::npos) << codec;
  }
}

/// Pictures between which others are left out, at the pace of the motion.
TEST(Video, OfEveryOtherPicture) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not on the PATH";
  const tests::TemporaryDirectory dir;
  VideoJob job = job_of(dir, "a folder", 1, 7, 64, 48);
  job.every = 3;
  for (const int frame : {2, 3, 5, 6}) fs::remove(dir.path() / "a folder" / frame_file(frame, ".png"));
  ASSERT_TRUE(make_video(job, never));
  const std::string text = probe(job.output, dir.path());
  for (const char* fact : {"nb_frames=3", "r_frame_rate=25/6"})
    EXPECT_NE(text.find(fact), std::string::npos) << fact << " is not in " << text;
}

TEST(Video, KeepsTheColours) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not on the PATH";
  const tests::TemporaryDirectory dir;
  const VideoJob job = job_of(dir, "frames", 3, 3, 64, 48);
  ASSERT_TRUE(make_video(job, never));
  const fs::path raw = dir.path() / "raw";
  run_process(
      {"ffmpeg", "-v", "error", "-i", job.output.string(), "-vf", "scale=in_color_matrix=bt709:in_range=tv",
       "-f", "rawvideo", "-pix_fmt", "rgb24", raw.string()},
      never);
  const std::string bytes = tests::read_all(raw);
  ASSERT_EQ(bytes.size(), 64U * 48U * 3U);
  const std::array expected = {120, 200, 100};
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(static_cast<unsigned char>(bytes[3 * (24 * 64 + 32) + c]), expected[c], 3) << c;
  }
}

/// Its frame as 8-bit R, G, B, A.
std::string pixels_of(const fs::path& video, const fs::path& folder) {
  const fs::path raw = folder / "raw";
  run_process({"ffmpeg", "-v", "error", "-y", "-i", video.string(), "-vf",
               "scale=in_color_matrix=bt709:in_range=tv", "-f", "rawvideo", "-pix_fmt", "rgba", raw.string()},
              never);
  return tests::read_all(raw);
}

TEST(Video, LaysPicturesWithAlphaOverAColour) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not on the PATH";
  const tests::TemporaryDirectory dir;
  VideoJob job = job_of(dir, "frames", 3, 4, 63, 48);  // an odd side
  for (int frame = 3; frame <= 4; ++frame) {
    render::Picture picture{63, 48, {}, {}};
    for (int i = 0; i < 63 * 48; ++i) {
      for (const int value : {120, 200, 100}) picture.rgb.push_back(static_cast<std::uint8_t>(value));
      picture.alpha.push_back(i % 63 < 21 ? 0 : i % 63 < 42 ? 128 : 255);
    }
    write_file(job.pictures / frame_file(frame, ".png"), render::encode_png(picture, 1));
  }
  job.under = {240, 40, 80};
  ASSERT_TRUE(make_video(job, never));
  EXPECT_NE(probe(job.output, dir.path()).find("nb_frames=2"), std::string::npos);
  const auto at = [](const std::string& bytes, std::size_t x, std::size_t k) {
    return static_cast<int>(static_cast<unsigned char>(bytes.at(4 * (24 * 64 + x) + k)));
  };
  const std::string bytes = pixels_of(job.output, dir.path());
  const int under[] = {240, 40, 80}, own[] = {120, 200, 100};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(at(bytes, 10, k), under[k], 4) << k;
    EXPECT_NEAR(at(bytes, 31, k), (under[k] + own[k]) / 2, 4) << k;
    EXPECT_NEAR(at(bytes, 55, k), own[k], 4) << k;
  }
  // Two codecs keep it.
  job.codec = "webp";
  job.output = dir.path() / "video.webp";
  ASSERT_TRUE(make_video(job, never));
  EXPECT_NE(tests::read_all(job.output).find("ALPH"), std::string::npos);
  job.codec = "prores4444";
  job.output = dir.path() / "video.mov";
  ASSERT_TRUE(make_video(job, never));
  const std::string kept = pixels_of(job.output, dir.path());
  EXPECT_NEAR(at(kept, 10, 3), 0, 2);
  EXPECT_NEAR(at(kept, 31, 3), 128, 3);
  EXPECT_NEAR(at(kept, 55, 3), 255, 2);
  EXPECT_NEAR(at(kept, 55, 1), 200, 4);
}

TEST(Video, OddSidesGetOneMoreLine) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not on the PATH";
  const tests::TemporaryDirectory dir;
  for (const auto& [width, height, expected] : {std::tuple(33, 25, "width=34 height=26"),
                                                {33, 24, "width=34 height=24"},
                                                {1, 1, "width=2 height=2"}}) {
    const VideoJob job = job_of(dir, "frames", 0, 1, width, height);
    ASSERT_TRUE(make_video(job, never));
    EXPECT_NE(probe(job.output, dir.path()).find(expected), std::string::npos) << expected;
  }
}

TEST(Video, FolderNamesAreNoPatterns) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not on the PATH";
  const tests::TemporaryDirectory dir;
  EXPECT_TRUE(make_video(job_of(dir, "100% %d: [a] 'b' *", 0, 1, 16, 16), never));
  const fs::path before = fs::current_path();
  fs::current_path(dir.path());
  VideoJob job = job_of(dir, "plain", 0, 1, 16, 16);
  job.pictures = "plain";
  job.output = "-dash:colon%d.mp4";
  EXPECT_TRUE(make_video(job, never));
  fs::current_path(before);
  EXPECT_TRUE(fs::exists(dir.path() / job.output));
}

TEST(Video, AFailureTellsTheCommandToRunLater) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not on the PATH";
  const tests::TemporaryDirectory dir;
  VideoJob job = job_of(dir, "frames", 0, 1, 16, 16);
  job.first = 8;
  try {
    make_video(job, never);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.status, ExitStatus::machine);
    const std::string text = error.what();
    EXPECT_NE(text.find("No such file or directory"), std::string::npos) << text;
    EXPECT_TRUE(text.ends_with("make the video later with: " + shell_text(ffmpeg_command(job)))) << text;
  }
  EXPECT_EQ(tests::count_files(dir.path()), 0);
}

TEST(Video, WithoutFfmpegTheMessageSaysSo) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  std::string text;
  try {
    make_video({"frames", 0, 4, 30.0, 64, 48, "x.mp4"}, never);
  } catch (const Error& error) {
    EXPECT_EQ(error.status, ExitStatus::machine);
    text = error.what();
  }
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_TRUE(text.starts_with("--video: ffmpeg is not on the PATH; the pictures are there")) << text;
  EXPECT_TRUE(text.ends_with(" x.mp4")) << text;
}

TEST(Video, StopsWhenAsked) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not on the PATH";
  const tests::TemporaryDirectory dir;
  EXPECT_FALSE(make_video(job_of(dir, "frames", 0, 1, 512, 512), [] { return true; }));
  EXPECT_EQ(tests::count_files(dir.path()), 0);
}

}  // namespace video_test
}  // namespace lagomorph::apps
