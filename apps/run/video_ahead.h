#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "apps/run/paths.h"
#include "apps/run/record.h"
#include "apps/video/video.h"
#include "render/color.h"

namespace lagomorph::apps {

/// Encodes a run's video while its pictures are made, each as soon as those before it are there. It may fail
/// and tell nobody: the video is then made after them.
class VideoAhead {
public:
  /// `there`: frames whose pictures are there and stay.
  VideoAhead(VideoJob, const RunPaths&, std::set<int> there);
  /// Gives up where finish() was not called; nothing of the video is left then.
  ~VideoAhead();
  VideoAhead(const VideoAhead&) = delete;
  VideoAhead& operator=(const VideoAhead&) = delete;

  /// The frame's picture is there now, and the SHA-256 of its file. From any thread.
  void picture_written(int frame, render::Picture, const std::string& sha256);
  /// No more are written. True: the job's video is in its place, of just the pictures that the records tell
  /// of.
  bool finish(const VideoJob&, const std::map<int, FrameRecord>& records);

private:
  /// A picture that was just written.
  struct Written {
    render::Picture picture;
    std::string sha256;  // of its file
  };
  /// Of a frame, as ffmpeg takes it.
  struct Shown {
    std::vector<std::uint8_t> pixels;
    std::string sha256;
  };
  void encode();
  std::optional<Shown> wait_for(int frame);
  std::optional<Shown> read(int frame) const;

  const VideoJob job_;
  const RunPaths paths_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::set<int> there_;
  std::map<int, Written> ready_;          // a few, so that they need not be read
  bool last_ = false, gives_up_ = false;  // no more are written; what is there is not wanted
  bool done_ = false;
  std::map<int, std::string> hashes_;  // SHA-256 of what was encoded
  std::filesystem::path file_;
  std::thread thread_;
};

}  // namespace lagomorph::apps
