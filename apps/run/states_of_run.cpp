#include "apps/run/states_of_run.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/hash.h"

namespace lagomorph::apps {

namespace fs = std::filesystem;

StatesOfRun::StatesOfRun(const RunPaths& paths, const Identity& of_run, int frame_count) : paths_(paths) {
  std::error_code error;
  for (const auto& [frame, record] : read_records(paths)) {
    if (frame >= frame_count || !record.state || record.state->made_by != of_run.state_maker()) continue;
    if (fs::is_regular_file(paths.state(frame), error)) records_.emplace(frame, *record.state);
  }
  if (!records_.empty()) return;
  throw Error(ExitStatus::wrong_input,
              fmt::format("{}: has no states; lagomorph simulate {} --out {} makes them",
                          paths.root().string(), paths.scene().string(), paths.root().string()));
}

FrameRange StatesOfRun::all() const {
  const int first = records_.begin()->first;
  FrameRange range{first, first};
  while (records_.contains(range.last + 1)) ++range.last;
  return range;
}

void StatesOfRun::require(FrameRange range) const {
  std::vector<char> good(static_cast<std::size_t>(range.last - range.first + 1), 0);
  tbb::parallel_for(range.first, range.last + 1, [&](int frame) {
    const auto record = records_.find(frame);
    good[static_cast<std::size_t>(frame - range.first)] =
        record != records_.end() && sha256_file(paths_.state(frame)) == record->second.sha256 ? 1 : 0;
  });
  const auto bad = std::find(good.begin(), good.end(), 0);
  if (bad == good.end()) return;
  const int frame = range.first + static_cast<int>(bad - good.begin());
  throw Error(ExitStatus::wrong_input,
              fmt::format("{}: {}; lagomorph simulate {} --out {} makes it", paths_.state(frame).string(),
                          records_.contains(frame) ? "is not what its record tells" : "is not there",
                          paths_.scene().string(), paths_.root().string()));
}

void StatesOfRun::bring_to(const RunPaths& run, std::map<int, FrameRecord>& records) const {
  make_folder(run.states());
  make_folder(run.records());
  std::error_code error;
  for (const auto& [frame, state] : records_) {
    FrameRecord& record = records[frame];
    const bool known = record.state && record.state->sha256 == state.sha256;
    if (known && fs::is_regular_file(run.state(frame), error)) continue;
    link_file(paths_.state(frame), run.state(frame));
    record.frame = frame;
    record.state = state;
    if (record.picture && record.picture->of_state != state.sha256) record.picture.reset();
    write_record(run, record);
  }
}

}  // namespace lagomorph::apps
