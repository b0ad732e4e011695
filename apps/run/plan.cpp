#include "apps/run/plan.h"

#include <filesystem>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "apps/error.h"
#include "apps/hash.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& file, const std::string& sha256) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return false;
  try {
    return sha256_file(file) == sha256;
  } catch (const Error&) {
    return false;  // unreadable: made again
  }
}

}  // namespace

bool picture_is_there(const RunPaths& paths, const FrameRecord& record) {
  if (!record.picture || !is_there(paths.picture(record.frame), record.picture->sha256)) return false;
  for (const auto& [channel, sha256] : record.picture->channels) {
    if (!is_there(paths.channel(channel, record.frame), sha256)) return false;
  }
  return true;
}

std::vector<FrameJob> missing_frames(const RunPaths& paths, const std::map<int, FrameRecord>& matching,
                                     int last, std::optional<FrameRange> drawn) {
  std::vector<FrameJob> jobs(static_cast<std::size_t>(last) + 1);
  tbb::parallel_for(0, last + 1, [&](int frame) {
    const auto found = matching.find(frame);
    const bool wanted = drawn && drawn->has(frame);
    FrameJob& job = jobs[static_cast<std::size_t>(frame)];
    job.frame = frame;
    job.simulate = found == matching.end() || !is_there(paths.state(frame), found->second.state->sha256);
    job.draw = wanted && (job.simulate || !picture_is_there(paths, found->second));
  });
  std::erase_if(jobs, [](const FrameJob& job) { return !job.simulate && !job.draw; });
  return jobs;
}

FrameRange wanted_frames(const std::optional<FrameRange>& asked, int frame_count) {
  const FrameRange all{0, frame_count - 1};
  if (!asked) return all;
  if (asked->first < 0 || asked->first > asked->last || asked->last > all.last) {
    throw Error(ExitStatus::wrong_input, fmt::format("--frames {}..{}: the scene has frames 0..{}",
                                                     asked->first, asked->last, all.last));
  }
  return *asked;
}

}  // namespace lagomorph::apps
