#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/cli/print.h"
#include "apps/commands.h"
#include "apps/export/frame_formats.h"
#include "apps/file_io.h"
#include "apps/pipeline/build_scene.h"
#include "apps/pipeline/production.h"
#include "apps/pipeline/stop.h"
#include "apps/run/plan.h"
#include "apps/run/run_json.h"
#include "apps/run/state_file.h"
#include "apps/run/states_of_run.h"
#include "apps/scene/scene.h"
#include "sim/parallel.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

RunInfo info_of(const RunPaths& run) {
  std::error_code error;
  if (!fs::is_directory(run.root(), error)) {
    wrong_input(run.root().string() + (fs::exists(run.root(), error)
                                           ? ": is a file; export takes a run's folder"
                                           : ": there is no such run"));
  }
  std::optional<RunInfo> info = read_run_info(run);
  if (!info) wrong_input(run.root().string() + ": is no run: it has no run.json");
  return std::move(*info);
}

/// Those asked for, or what the format gives.
std::vector<std::string> fields_for(const Options& options, const FrameFormat& format) {
  if (!options.fields.empty() && !format.takes_fields)
    wrong_input(fmt::format("--fields: .{} holds no fields; vtu and ply do", format.name));
  for (const std::string& name : options.fields) sim::find_field(name);
  std::vector<std::string> names = options.fields;
  if (names.empty() && format.all_fields) {
    for (const sim::FieldInfo& info : sim::field_table()) names.emplace_back(info.name);
  }
  return names;
}

/// The files by their times, for ParaView.
std::string collection(const std::vector<std::pair<double, std::string>>& files) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (const auto& [time, file] : files)
    text += fmt::format("<DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}\"/>\n", time, file);
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace

ExitStatus export_command(const Options& options) {
  const StopSignals signals;
  Progress progress(options.quiet || options.json);
  const sim::ThreadLimit limit(thread_count(options));
  const RunPaths run(options.inputs.at(0));
  const FrameFormat& format = find_format(options.format.value_or("vtu"));
  const std::vector<std::string> fields = fields_for(options, format);
  const RunInfo info = info_of(run);
  const SceneDesc scene = load_scene(run.scene(), {});
  const StatesOfRun states(run, info.identity, scene.time.frames);
  const FrameRange frames = options.frames ? wanted_frames(options.frames, scene.time.frames) : states.all();
  states.require(frames);
  const sim::Model model = build_model(scene, progress);
  const ExportedScene exported{model, build_surfaces(scene, model, progress), fields};
  const fs::path out = options.out.value_or(run.root() / "export");
  make_folder(out);
  remove_leftovers(out);

  std::vector<std::pair<double, std::string>> files;  // by their times
  progress.begin(frames.last - frames.first + 1);
  for (int frame = frames.first; frame <= frames.last && !stop_asked(); ++frame) {
    const fs::path file = run.state(frame);
    const sim::State state =
        decode_state(read_file(file), file.string(), frame, scene.time.fps, model.mesh().vertex_count());
    files.emplace_back(state.t, frame_file(frame, fmt::format(".{}", format.name)));
    write_file(out / files.back().second, format.bytes(exported, state));
    progress.frame_done();
  }
  progress.end();
  if (stop_asked()) return stop_status();
  const std::string list = std::string(format.name) == "vtu" ? scene.name + ".pvd" : "";
  if (!list.empty()) write_file(out / list, collection(files));
  if (options.json) {
    nlohmann::ordered_json json = {{"out", out.string()},
                                   {"format", format.name},
                                   {"frames", {frames.first, frames.last}},
                                   {"fields", fields},
                                   {"files", nlohmann::ordered_json::array()}};
    for (const auto& [time, file] : files) json["files"].push_back(file);
    if (!list.empty()) json["files"].push_back(list);
    print(json.dump() + "\n");
  } else if (!options.quiet) {
    print(fmt::format("{} frames as .{} in {}\n", files.size(), format.name, out.string()));
  }
  return ExitStatus::done;
}

}  // namespace lagomorph::apps
