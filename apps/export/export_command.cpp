#include <algorithm>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/cli/print.h"
#include "apps/commands.h"
#include "apps/export/formats.h"
#include "apps/export/obj.h"
#include "apps/export/pictures.h"
#include "apps/file_io.h"
#include "apps/pipeline/build_scene.h"
#include "apps/pipeline/camera_rig.h"
#include "apps/pipeline/production.h"
#include "apps/pipeline/stop.h"
#include "apps/pipeline/surface_fields.h"
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
std::vector<std::string> fields_for(const Options& options, const ExportFormat& format) {
  if (!options.fields.empty() && !format.takes_fields)
    wrong_input(fmt::format("--fields: .{} holds no fields; vtu, ply and usda do", format.name));
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

bool shows_field(const SceneDesc& scene) {
  return std::any_of(scene.body.begin(), scene.body.end(),
                     [](const BodyDesc& body) { return !body.shown.is_none(); });
}

bool moves(const CameraDesc& c) {
  return !c.key.empty() || c.turntable.turns || c.turntable.period || c.follow != "none";
}

/// Whether some key changes how much it sees.
bool zooms(const CameraDesc& c) {
  return std::any_of(c.key.begin(), c.key.end(),
                     [](const CameraKey& k) { return k.fov || k.orthographic || k.zoom; });
}

/// The colours of one frame stand for all: of that asked for, or else of the first where a body shows most of
/// its range. Ranges are those of pictures: automatic ones of all states that RUN holds. None where nothing
/// shows a field.
void add_colors(ExportedScene& scene, const StatesOfRun& states, const std::function<sim::State(int)>& state,
                FrameRange frames, std::optional<int> wanted) {
  SurfaceFields fields(scene.desc, scene.model, scene.surfaces);
  if (fields.is_empty()) return;
  if (fields.is_automatic())
    for (const auto& [seen, record] : states.records()) fields.see(state(seen).q);
  int best = frames.first;
  if (!wanted) {
    double most = -1.0;
    for (int frame = frames.first; frame <= frames.last; ++frame) {
      const double spread = fields.spread(state(frame).q);
      if (spread > most + 1e-9) most = spread, best = frame;
    }
  }
  scene.color_frame = wanted.value_or(best);
  scene.colors = fields.colors(state(scene.color_frame).q);
}

/// A file a frame, for vtu the list of their times, and for obj first the materials. False: asked to stop.
bool write_frames(const ExportedSequence& sequence, const ExportFormat& format, const fs::path& out,
                  std::vector<std::string>& files) {
  make_folder(out);
  std::vector<std::pair<double, std::string>> times;
  const std::string_view name = format.name;
  if (name == "obj") {
    files.push_back(obj_library_name(sequence.scene.desc));
    write_file(out / files.back(), obj_library(sequence.scene));
  }
  sequence.begin(1);
  const bool all = sequence.each([&](const sim::State& state) {
    files.push_back(frame_file(state.frame, format.extension));
    times.emplace_back(state.t, files.back());
    write_file(out / files.back(), format.frame(sequence.scene, state));
  });
  if (!all || name != "vtu") return all;
  files.push_back(sequence.scene.desc.name + ".pvd");
  write_file(out / files.back(), collection(times));
  return true;
}

}  // namespace

ExitStatus export_command(const Options& options) {
  const StopSignals signals;
  if (options.format == "png") return export_pictures(options);
  if (options.pattern) wrong_input("--pattern: names of --format png; the other formats have their own");
  Progress progress(options.quiet || options.json);
  const sim::ThreadLimit limit(thread_count(options));
  const RunPaths run(options.inputs.at(0));
  const ExportFormat& format = find_format(options.format.value_or("vtu"));
  const std::vector<std::string> fields = fields_for(options, format);
  if (options.color_frame && !format.takes_colors)
    wrong_input("--color-frame: of --format gltf, the others have no colours or those of each frame");
  const RunInfo info = info_of(run);
  const SceneDesc scene = load_scene(run.scene(), {});
  if (options.color_frame && !shows_field(scene))
    wrong_input(
        "--color-frame: no body of the run shows a field; lagomorph render --set body.0.look.field=von_mises "
        "gives it one");
  const StatesOfRun states(run, info.identity, scene.time.frames);
  const FrameRange frames = options.frames ? wanted_frames(options.frames, scene.time.frames) : states.all();
  states.require(frames);
  if (options.color_frame) {
    const int frame = *options.color_frame;
    if (frame < 0 || frame >= scene.time.frames)
      wrong_input(fmt::format("--color-frame {}: the scene has frames 0..{}", frame, scene.time.frames - 1));
    states.require({frame, frame});
  }
  const sim::Model model = build_model(scene, progress);
  const auto state = [&](int frame) {
    return read_state(run.state(frame), frame, scene.time.fps, model.mesh().vertex_count());
  };
  ExportedScene exported{scene, model, build_surfaces(scene, model, progress), fields, scene.camera, {}};
  std::optional<CameraRig> rig;
  if (format.sequence != nullptr) {
    rig.emplace(scene, model, exported.surfaces, scene.render.width, scene.render.height);
    if (rig->needs_all_states())
      for (const auto& [frame, record] : states.records()) rig->see(state(frame).q);
    exported.camera = rig->settings(frames.first, state(frames.first).q);
    if (moves(scene.camera) && frames.last > frames.first)
      exported.moving_camera = [&rig](const sim::State& s) { return rig->settings(s.frame, s.q); };
    if (std::string_view(format.name) == "gltf" && zooms(scene.camera))
      progress.note(fmt::format("the camera keeps its field of view of frame {} in a .glb", frames.first));
  }
  if (format.takes_colors) add_colors(exported, states, state, frames, options.color_frame);
  if (format.remarks != nullptr)
    for (const std::string& line : format.remarks(exported)) progress.note(line);
  const fs::path out = options.out.value_or(run.root() / "export");
  remove_leftovers(out);
  const ExportedSequence sequence{
      exported,
      frames,
      state,
      stop_asked,
      [&] { progress.frame_done(); },
      [&](int passes) { progress.begin(frames.last - frames.first + 1, passes); }};

  std::vector<std::string> files;
  if (format.sequence != nullptr) {
    files.push_back(scene.name + format.extension);
    if (!format.sequence(sequence, out / files.back())) return stop_status();
  } else if (!write_frames(sequence, format, out, files)) {
    return stop_status();
  }
  progress.end();
  if (options.json) {
    nlohmann::ordered_json json = {{"out", out.string()},
                                   {"format", format.name},
                                   {"frames", {frames.first, frames.last}},
                                   {"fields", fields},
                                   {"files", files}};
    if (!exported.colors.empty()) json["color_frame"] = exported.color_frame;
    print(json.dump() + "\n");
  } else if (!options.quiet) {
    print(fmt::format("{} frame{} as {} in {}\n", sequence.count(), sequence.count() == 1 ? "" : "s",
                      format.extension,
                      format.sequence != nullptr ? (out / files.back()).string() : out.string()));
  }
  return ExitStatus::done;
}

}  // namespace lagomorph::apps
