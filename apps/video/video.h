#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/frame_names.h"

namespace lagomorph::apps {

/// Pictures first..last of a folder that become a video.
struct VideoJob {
  std::filesystem::path pictures;
  int first = 0;
  int last = 0;
  double fps = 30.0;
  int width = 0, height = 0;  // of the pictures
  std::filesystem::path output;
  std::string codec = "h264";  // see video_codecs()
  int every = 1;               // only every Nth of the pictures
  /// sRGB that pictures with alpha are laid over, unless the codec keeps it; none: the pictures are opaque.
  std::optional<std::array<std::uint8_t, 3>> under = {};
  FrameNames names = {};  // of the pictures
};

/// h264 and h265 (.mp4, faststart), vp9 (.webm), prores (422 HQ, .mov), prores4444 (.mov, with alpha), and
/// animated pictures: webp (with alpha), gif.
std::vector<std::string> video_codecs();
/// With its dot. Throws Error(wrong_input) for a codec that is none.
std::string video_extension(const std::string& codec);

/// What of a video of so many pictures a second is not there; empty: nothing. Throws as video_extension()
/// does.
std::string rate_remark(const std::string& codec, double rate);

/// Of the pictures first, first + every, ..., that many frames of the sequence apart in time. Videos are
/// BT.709, yuv420p, of prores yuv422p10, of prores4444 yuva444p10; an odd side gets one more line of its last
/// pixels. The same pictures give the same bytes with the same ffmpeg.
std::vector<std::string> ffmpeg_command(const VideoJob&);

/// The same, for the pictures' pixels one after the other on its input: 8 bits each of red, green and blue,
/// and of alpha where pictures have it (`under`).
std::vector<std::string> fed_ffmpeg_command(const VideoJob&);

/// Makes the video through ffmpeg and renames it into its place. Returns false when `stop` ended it. Throws
/// Error(machine) with the command to run later when ffmpeg is not there or fails.
bool make_video(const VideoJob&, const std::function<bool()>& stop);

}  // namespace lagomorph::apps
