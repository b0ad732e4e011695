#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace lagomorph::apps {

/// Pictures frame_%04d.png first..last of a folder that become a video.
struct VideoJob {
  std::filesystem::path pictures;
  int first = 0;
  int last = 0;
  double fps = 30.0;
  int width = 0, height = 0;  // of the pictures
  std::filesystem::path output;
};

/// H.264, yuv420p, faststart, BT.709; an odd side gets one more line of its last pixels. The same pictures
/// give the same bytes with the same ffmpeg.
std::vector<std::string> ffmpeg_command(const VideoJob&);

/// Makes the video through ffmpeg and renames it into its place. Returns false when `stop` ended it. Throws
/// Error(machine) with the command to run later when ffmpeg is not there or fails.
bool make_video(const VideoJob&, const std::function<bool()>& stop);

}  // namespace lagomorph::apps
