#include "apps/run/result.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/progress/progress.h"
#include "apps/run/solves_text.h"

namespace lagomorph::apps {
namespace {

using Json = nlohmann::ordered_json;

/// Seconds that a frame takes on average, over the frames that are there.
struct MeanSeconds {
  double simulation = 0.0, rendering = 0.0, writing = 0.0;
};

MeanSeconds mean_seconds(const std::map<int, FrameRecord>& records) {
  MeanSeconds mean;
  int steps = 0, pictures = 0;
  for (const auto& [frame, record] : records) {
    if (record.state && frame > 0) {
      mean.simulation += record.state->seconds;
      ++steps;
    }
    if (record.picture) {
      mean.rendering += record.picture->rendering_seconds;
      mean.writing += record.picture->writing_seconds;
      ++pictures;
    }
  }
  mean.simulation /= std::max(steps, 1);
  mean.rendering /= std::max(pictures, 1);
  mean.writing /= std::max(pictures, 1);
  return mean;
}

std::string milliseconds(double seconds) { return fmt::format("{:.3g} ms", 1000.0 * seconds); }

std::string counted(int n, const char* what) { return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s"); }

/// What is said of a video that was made.
std::string video_text(const RunResult& result) {
  return "; made " + result.video +
         (result.video_replaced.empty() ? "" : " in place of " + result.video_replaced);
}

}  // namespace

std::string result_json(const RunResult& result) {
  const MeanSeconds mean = mean_seconds(result.records);
  const auto pictures = std::count_if(result.records.begin(), result.records.end(),
                                      [](const auto& r) { return r.second.picture.has_value(); });
  Json json = {{"run", result.run.string()},
               {"status", result.status},
               {"frames", result.frames},
               {"states", {{"there", result.records.size()}, {"made", result.states_made}}},
               {"pictures", {{"there", pictures}, {"made", result.pictures_made}}},
               {"seconds", result.seconds},
               {"seconds_per_frame",
                {{"simulation", mean.simulation}, {"rendering", mean.rendering}, {"writing", mean.writing}}},
               {"video", result.video.empty() ? Json(nullptr) : Json(result.video)}};
  if (!result.reason.empty()) json["reason"] = result.reason;
  return json.dump() + "\n";
}

std::string result_text(const RunResult& result) {
  std::string text = result.run.string() + ": ";
  const std::string frames = counted(result.frames, "frame");
  if (result.states_made + result.pictures_made == 0) {
    const std::string there = fmt::format("{} {} there and match", frames, result.frames == 1 ? "is" : "are");
    return text + (result.video_made ? there + video_text(result) : "nothing to do: " + there);
  }
  const MeanSeconds mean = mean_seconds(result.records);
  text += fmt::format("{} in {}", frames, duration_text(result.seconds));
  if (result.states_made > 0) {
    text += fmt::format("; {} simulated, {} each", counted(result.states_made, "state"),
                        milliseconds(mean.simulation));
    sim::SolveCounts solves;
    for (const auto& [frame, record] : result.records)
      if (record.state) solves += record.state->report.solves;
    if (const std::string way = way_text(solves); !way.empty()) text += ", by " + way;
  }
  if (result.pictures_made > 0) {
    text += fmt::format("; {} drawn, {} each and {} to write", counted(result.pictures_made, "picture"),
                        milliseconds(mean.rendering), milliseconds(mean.writing));
  }
  if (result.video_made) text += video_text(result);
  return text;
}

}  // namespace lagomorph::apps
