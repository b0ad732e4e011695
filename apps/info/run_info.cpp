#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/frame_ranges.h"
#include "apps/info/info.h"
#include "apps/run/paths.h"
#include "apps/run/record.h"
#include "apps/run/run_json.h"
#include "apps/run/solves_text.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// What the frames' records add up to.
struct Sums {
  std::vector<int> states, pictures;
  double simulation = 0.0, rendering = 0.0, writing = 0.0;  // [s]
  double residual = 0.0;                                    // the largest
  int iterations = 0;                                       // of Newton's method
  sim::SolveCounts solves;
};

Sums sums_of(const RunPaths& paths, const std::map<int, FrameRecord>& records) {
  Sums sums;
  std::error_code none;
  for (const auto& [frame, record] : records) {
    if (record.state && fs::exists(paths.state(frame), none)) {
      sums.states.push_back(frame);
      sums.simulation += record.state->seconds;
      sums.residual = std::max(sums.residual, record.state->report.residual);
      sums.iterations += record.state->report.newton_iterations;
      sums.solves += record.state->report.solves;
    }
    if (record.picture && fs::exists(paths.picture(frame), none)) {
      sums.pictures.push_back(frame);
      sums.rendering += record.picture->rendering_seconds;
      sums.writing += record.picture->writing_seconds;
    }
  }
  return sums;
}

void add_frames(Report& report, const Sums& sums, int frames) {
  const auto add = [&](const char* label, const char* key, const std::vector<int>& there) {
    const auto within = std::count_if(there.begin(), there.end(), [&](int frame) { return frame < frames; });
    report.add(label, fmt::format("{} of {}: {}", count_text(within), count_text(frames), ranges_text(there)),
               key, there);
    return within == frames;
  };
  const bool stepped = add("states", "states", sums.states);
  const bool drawn = add("pictures", "pictures", sums.pictures);
  const std::string status = !stepped ? "unfinished" : drawn ? "complete" : "simulated, not all drawn";
  report.add("status", status, "status", status);
}

void add_seconds(Report& report, const Sums& sums) {
  const auto each = [](double seconds, std::size_t frames) {
    return frames == 0 ? 0.0 : seconds / static_cast<double>(frames);
  };
  const double simulation = each(sums.simulation, sums.states.size());
  const double rendering = each(sums.rendering, sums.pictures.size());
  const double writing = each(sums.writing, sums.pictures.size());
  report.add("seconds a frame",
             fmt::format("{} simulation, {} rendering, {} writing", number_text(simulation),
                         number_text(rendering), number_text(writing)),
             "seconds_per_frame",
             {{"simulation", simulation}, {"rendering", rendering}, {"writing", writing}});
  report.add("Newton",
             fmt::format("{} iterations a frame, largest residual {}",
                         number_text(each(sums.iterations, sums.states.size())), number_text(sums.residual)),
             "newton", {{"iterations", sums.iterations}, {"largest_residual", sums.residual}});
  report.add("linear systems", solves_text(sums.solves), "linear_systems", solves_json(sums.solves));
}

void add_energy(Report& report, const std::map<int, FrameRecord>& records) {
  const FrameRecord* first = nullptr;
  const FrameRecord* last = nullptr;
  for (const auto& [frame, record] : records) {
    if (!record.state) continue;
    if (first == nullptr) first = &record;
    last = &record;
  }
  if (first == nullptr) return;
  const double begin = first->state->energy.total(), end = last->state->energy.total();
  report.add("total energy",
             fmt::format("{} J at frame {}, {} J at frame {}", number_text(begin), first->frame,
                         number_text(end), last->frame),
             "total_energy", {{"first", begin}, {"last", end}});
}

}  // namespace

Report run_info(const fs::path& folder) {
  const RunPaths paths = paths_of_run(folder);
  const std::optional<RunInfo> info = read_run_info(paths);
  if (!info) wrong_input(fmt::format("{}: is no run: it has no run.json", folder.string()));
  int frames = 0;
  double fps = 0.0;
  std::string name, program;
  try {
    name = info->about.at("name").get<std::string>();
    program = info->about.at("lagomorph").get<std::string>();
    frames = info->about.at("scene").at("time").at("frames").get<int>();
    fps = info->about.at("scene").at("time").at("fps").get<double>();
  } catch (const Json::exception& e) {
    wrong_input(fmt::format("{}: is not a run's run.json ({})", paths.run_json().string(), e.what()));
  }
  const std::map<int, FrameRecord> records = read_records(paths);
  const Sums sums = sums_of(paths, records);

  Report report(fmt::format("{}: run of '{}'", folder.string(), name), "run", folder.string());
  report.add_json("name", name);
  report.add("made by", "lagomorph " + program, "lagomorph", program);
  report.add("time", fmt::format("{} frame{} at {} 1/s", count_text(frames), frames == 1 ? "" : "s", fps),
             "time", {{"frames", frames}, {"fps", fps}});
  add_frames(report, sums, frames);
  add_seconds(report, sums);
  add_energy(report, records);
  if (info->video) {
    report.add(
        "video", fmt::format("{}, frames {}..{}", info->video->file, info->video->first, info->video->last),
        "video", {{"file", info->video->file}, {"first", info->video->first}, {"last", info->video->last}});
  }
  report.add("simulation", info->identity.simulation_hash(), "simulation_hash",
             info->identity.simulation_hash());
  const std::string& picture = info->identity.picture_hash();
  if (!picture.empty()) report.add("picture", picture, "picture_hash", picture);
  return report;
}

}  // namespace lagomorph::apps
