#include "apps/run/gather.h"

#include <filesystem>
#include <system_error>

#include "apps/file_io.h"
#include "apps/run/contents.h"
#include "apps/run/energy_csv.h"
#include "apps/run/lock.h"
#include "apps/run/newton_csv.h"

namespace lagomorph::apps {

namespace fs = std::filesystem;

std::map<int, FrameRecord> gather(const RunPaths& paths, const RunInfo& info, int frame_count) {
  RunLock lock(paths.records());  // who gathers last has seen the records of all that share the frames
  lock.wait_for(RunLock::Kind::exclusive);
  std::map<int, FrameRecord> frames;
  std::error_code error;
  for (const auto& [frame, record] : read_records(paths)) {
    FrameRecord parts = matching_parts(record, info.identity);
    if (frame >= frame_count || !parts.state || !fs::exists(paths.state(frame), error)) continue;
    if (!fs::exists(paths.picture(frame), error)) parts.picture.reset();
    frames.emplace(frame, std::move(parts));
  }
  write_file_if_changed(paths.energy(), energy_csv(frames), Durable::yes);
  const std::string newton = newton_csv(frames);
  if (!newton.empty()) write_file_if_changed(paths.newton(), newton, Durable::yes);
  if (newton.empty() && fs::exists(paths.newton(), error)) remove_file(paths.newton());
  write_file_if_changed(paths.run_json(), run_json_text(info, frames), Durable::yes);
  return frames;
}

}  // namespace lagomorph::apps
