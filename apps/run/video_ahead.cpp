#include "apps/run/video_ahead.h"

#include <cstddef>
#include <exception>
#include <utility>
#include <variant>

#include "apps/file_io.h"
#include "apps/hash.h"
#include "apps/video/process.h"
#include "render/pixels.h"
#include "render/png_read.h"

namespace lagomorph::apps {
namespace {

constexpr std::size_t most_ready = 8;  // pictures in memory; ffmpeg takes them about as they come

bool is_shown(const VideoJob& job, int frame) {
  return frame >= job.first && frame <= job.last && (frame - job.first) % job.every == 0;
}

/// As ffmpeg takes them; none where the picture is not like the job's others.
std::optional<std::vector<std::uint8_t>> samples_of(render::Pixels pixels, const VideoJob& job) {
  auto* const samples = std::get_if<std::vector<std::uint8_t>>(&pixels.samples);
  if (samples == nullptr || pixels.width != job.width || pixels.height != job.height ||
      pixels.alpha != job.under.has_value())
    return std::nullopt;
  return std::move(*samples);
}

}  // namespace

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

void VideoAhead::picture_written(int frame, render::Picture picture, const std::string& sha256) {
  {
    const std::lock_guard lock(mutex_);
    there_.insert(frame);
    if (ready_.size() < most_ready && is_shown(job_, frame)) ready_[frame] = {std::move(picture), sha256};
  }
  changed_.notify_all();
}

/// None: it will not be there, or is not like the others.
std::optional<VideoAhead::Shown> VideoAhead::wait_for(int frame) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return gives_up_ || last_ || there_.contains(frame); });
  if (gives_up_ || !there_.contains(frame)) return std::nullopt;
  const auto ready = ready_.extract(frame);
  lock.unlock();
  if (ready) {
    Written& written = ready.mapped();
    if (auto samples = samples_of(render::to_pixels(std::move(written.picture)), job_))
      return Shown{std::move(*samples), std::move(written.sha256)};
  }
  return read(frame);
}

std::optional<VideoAhead::Shown> VideoAhead::read(int frame) const {
  const std::string png = read_file(paths_.picture(frame));
  auto samples = samples_of(render::read_png(png, paths_.picture(frame).string()), job_);
  if (!samples) return std::nullopt;
  return Shown{std::move(*samples), sha256(png)};
}

void VideoAhead::encode() {
  VideoJob job = job_;
  job.output = file_;
  FedProcess ffmpeg(fed_ffmpeg_command(job));
  for (int frame = job.first; frame <= job.last; frame += job.every) {
    const std::optional<Shown> shown = wait_for(frame);
    if (!shown) return;
    hashes_[frame] = shown->sha256;
    if (!ffmpeg.feed({reinterpret_cast<const char*>(shown->pixels.data()), shown->pixels.size()})) return;
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
