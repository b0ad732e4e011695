#include "apps/export/pictures.h"

#include <filesystem>
#include <map>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/cli/print.h"
#include "apps/file_io.h"
#include "apps/frame_names.h"
#include "apps/hash.h"
#include "apps/pipeline/stop.h"
#include "apps/progress/progress.h"
#include "apps/run/paths.h"
#include "apps/run/plan.h"
#include "apps/run/record.h"
#include "apps/run/run_json.h"
#include "apps/scene/scene.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

/// The frames whose pictures there are, of those asked for.
std::vector<int> frames_of(const Options& options, const RunPaths& run, int frame_count) {
  const std::map<int, FrameRecord> records = read_records(run);
  const FrameRange range = wanted_frames(options.frames, frame_count);
  std::vector<int> frames;
  for (int frame = range.first; frame <= range.last; ++frame) {
    const auto record = records.find(frame);
    if (record != records.end() && record->second.picture) {
      if (!picture_is_there(run, record->second)) {
        wrong_input(fmt::format("{}: is not what its record tells; lagomorph render {} makes it",
                                run.picture(frame).string(), run.root().string()));
      }
      frames.push_back(frame);
    } else if (options.frames) {
      wrong_input(fmt::format("{}: is not there; lagomorph render {} --frames {} makes it",
                              run.picture(frame).string(), run.root().string(), frame));
    }
  }
  if (frames.empty()) {
    wrong_input(fmt::format("{}: has no pictures; lagomorph render {} makes them", run.root().string(),
                            run.root().string()));
  }
  return frames;
}

}  // namespace

ExitStatus export_pictures(const Options& options) {
  if (!options.fields.empty()) wrong_input("--fields: .png holds no fields; vtu, ply and usda do");
  Progress progress(options.quiet || options.json);
  const RunPaths run = paths_of_run(options.inputs.at(0));
  std::error_code error;
  if (!fs::is_directory(run.root(), error)) wrong_input(run.root().string() + ": there is no such run");
  if (!read_run_info(run)) wrong_input(run.root().string() + ": is no run: it has no run.json");
  const SceneDesc scene = load_scene(run.scene(), {});
  const FrameNames names(options.pattern.value_or(scene.name + ".####.png"));
  const std::vector<int> frames = frames_of(options, run, scene.time.frames);
  const fs::path out = options.out.value_or(run.root() / "export");
  make_folder(out);
  remove_leftovers(out);
  progress.begin(static_cast<int>(frames.size()));
  std::vector<std::string> files;
  for (const int frame : frames) {
    if (stop_asked()) return stop_status();
    files.push_back(names.file(frame, ".png"));
    write_file(out / files.back(), read_file(run.picture(frame)));
    progress.frame_done();
  }
  progress.end();
  if (options.json) {
    const nlohmann::ordered_json json = {{"out", out.string()},
                                         {"format", "png"},
                                         {"frames", {frames.front(), frames.back()}},
                                         {"fields", nlohmann::json::array()},
                                         {"files", files}};
    print(json.dump() + "\n");
  } else if (!options.quiet) {
    print(fmt::format("{} picture{} as {} in {}\n", files.size(), files.size() == 1 ? "" : "s",
                      names.pattern(), out.string()));
  }
  return ExitStatus::done;
}

}  // namespace lagomorph::apps
