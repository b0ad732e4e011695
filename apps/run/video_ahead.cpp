#include "apps/run/video_ahead.h"

#include <exception>
#include <utility>

#include "apps/file_io.h"
#include "apps/hash.h"
#include "apps/video/process.h"

namespace lagomorph::apps {

VideoAhead::VideoAhead(VideoJob job, const RunPaths& paths, std::set<int> there)
    : job_(std::move(job)), paths_(paths), there_(std::move(there)), file_(temporary_name(job_.output)) {
  thread_ = std::thread([this] {
    try {
      encode();
    } catch (const std::exception&) {
      done_ = false;
    }
  });
}

VideoAhead::~VideoAhead() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    gives_up_ = true;
  }
  changed_.notify_all();
  thread_.join();
  remove_file(file_);
}

void VideoAhead::picture_written(int frame) {
  {
    const std::lock_guard lock(mutex_);
    there_.insert(frame);
  }
  changed_.notify_all();
}

/// False: it will not be there.
bool VideoAhead::wait_for(int frame) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return gives_up_ || last_ || there_.contains(frame); });
  return !gives_up_ && there_.contains(frame);
}

void VideoAhead::encode() {
  VideoJob job = job_;
  job.output = file_;
  FedProcess ffmpeg(fed_ffmpeg_command(job));
  for (int frame = job.first; frame <= job.last; frame += job.every) {
    if (!wait_for(frame)) return;
    const std::string png = read_file(paths_.picture(frame));
    hashes_[frame] = sha256(png);
    if (!ffmpeg.feed(png)) return;
  }
  done_ = ffmpeg.finish();
}

bool VideoAhead::finish(const VideoJob& job, const std::map<int, FrameRecord>& records) {
  {
    const std::lock_guard lock(mutex_);
    last_ = true;
  }
  changed_.notify_all();
  thread_.join();
  bool same = done_ && ffmpeg_command(job) == ffmpeg_command(job_);
  for (int frame = job.first; same && frame <= job.last; frame += job.every)
    same = hashes_.at(frame) == records.at(frame).picture->sha256;
  if (same) {
    rename_into_place(file_, job.output);
  } else {
    remove_file(file_);
  }
  return same;
}

}  // namespace lagomorph::apps
