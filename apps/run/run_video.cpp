#include "apps/run/run_video.h"

#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/hash.h"
#include "apps/video/process.h"
#include "apps/video/video.h"
#include "render/channels.h"
#include "render/color.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

bool has_picture(const std::map<int, FrameRecord>& records, int frame) {
  const auto record = records.find(frame);
  return record != records.end() && record->second.picture.has_value();
}

/// Changes with the pictures and with how they are put together.
std::string source_hash(const VideoJob& job, const std::map<int, FrameRecord>& records) {
  VideoJob anywhere = job;  // a moved run has the same video
  anywhere.pictures = anywhere.output = "";
  std::string text = shell_text(ffmpeg_command(anywhere));
  for (int frame = job.first; frame <= job.last; frame += job.every)
    text += "\n" + records.at(frame).picture->sha256;
  return sha256(text);
}

bool is_up_to_date(const RunPaths& paths, const VideoRecord& there, const VideoRecord& wanted) {
  const fs::path file = paths.root() / wanted.file;
  std::error_code error;
  return there.file == wanted.file && there.source == wanted.source && fs::is_regular_file(file, error) &&
         sha256_file(file) == there.sha256;
}

/// The background's colour as the pictures would show it, or white.
std::optional<std::array<std::uint8_t, 3>> under_transparent(const SceneDesc& scene) {
  if (!scene.render.transparent) return std::nullopt;
  if (!scene.background) return std::array<std::uint8_t, 3>{255, 255, 255};
  render::Image pixel(1, 1);
  const render::Color& color = *scene.background;
  pixel.add(render::color_channel, 3) = {color.x(), color.y(), color.z()};
  const render::Picture shown = render::tone_map(pixel, scene.render.tone_curve, scene.render.exposure);
  return std::array<std::uint8_t, 3>{shown.rgb[0], shown.rgb[1], shown.rgb[2]};
}

/// Of all pictures around `frames` that have no gap between them.
VideoJob video_job(const RunPaths& paths, const SceneDesc& scene, const std::map<int, FrameRecord>& records,
                   FrameRange frames, const std::string& codec) {
  VideoJob job{paths.pictures(),
               frames.first,
               frames.last,
               scene.time.fps,
               scene.render.drawn().width(),
               scene.render.drawn().height(),
               paths.video(scene.name, video_extension(codec)),
               codec,
               frames.every,
               under_transparent(scene),
               paths.names()};
  job.last -= (job.last - job.first) % job.every;
  while (has_picture(records, job.first - job.every)) job.first -= job.every;
  while (has_picture(records, job.last + job.every)) job.last += job.every;
  return job;
}

}  // namespace

std::unique_ptr<VideoAhead> begin_video(const RunPaths& paths, const SceneDesc& scene,
                                        const std::map<int, FrameRecord>& records,
                                        const std::vector<FrameJob>& jobs, FrameRange frames,
                                        const std::string& codec) {
  std::set<int> there;
  for (const auto& [frame, record] : records) {
    if (record.picture) there.insert(frame);
  }
  for (const FrameJob& job : jobs) there.erase(job.frame);
  return std::make_unique<VideoAhead>(video_job(paths, scene, records, frames, codec), paths,
                                      std::move(there));
}

std::optional<VideoUpdate> update_video(const RunPaths& paths, const SceneDesc& scene,
                                        const std::map<int, FrameRecord>& records, FrameRange frames,
                                        const std::string& codec, const std::optional<VideoRecord>& there,
                                        VideoAhead* ahead, const std::function<bool()>& stop) {
  for (int frame = frames.first; frame <= frames.last; frame += frames.every) {
    if (has_picture(records, frame)) continue;
    throw Error(ExitStatus::wrong_input, "--video: " + paths.picture(frame).string() + " is not there");
  }
  const VideoJob job = video_job(paths, scene, records, frames, codec);
  VideoRecord wanted{job.output.filename().string(), job.first, job.last, source_hash(job, records), ""};
  if (there && is_up_to_date(paths, *there, wanted)) return VideoUpdate{*there, false, ""};
  const bool is_made = ahead != nullptr && ahead->finish(job, records);
  if (!is_made && !make_video(job, stop)) return std::nullopt;
  // A run has one video: another would stay behind when the pictures change.
  std::string replaced;
  if (there && there->file != wanted.file) {
    replaced = fs::path(there->file).filename().string();
    remove_file(paths.root() / replaced);
  }
  wanted.sha256 = sha256_file(job.output);
  return VideoUpdate{std::move(wanted), true, std::move(replaced)};
}

}  // namespace lagomorph::apps
