#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/file_io.h"
#include "apps/pipeline/build_scene.h"
#include "apps/pipeline/production.h"
#include "apps/pipeline/stop.h"
#include "apps/pipeline/stopwatch.h"
#include "apps/progress/progress.h"
#include "apps/run/contents.h"
#include "apps/run/draft.h"
#include "apps/run/plan.h"
#include "apps/run/states_of_run.h"
#include "apps/scene/scene.h"
#include "render/renderer.h"
#include "sim/parallel.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& what) { throw Error(ExitStatus::wrong_input, what); }

RunInfo info_of(const RunPaths& source) {
  std::error_code error;
  if (!fs::is_directory(source.root(), error)) {
    refuse(source.root().string() + (fs::exists(source.root(), error)
                                         ? ": is a file; render takes a run's folder"
                                         : ": there is no such run"));
  }
  std::optional<RunInfo> info = read_run_info(source);
  if (!info) refuse(source.root().string() + ": is no run: it has no run.json");
  return std::move(*info);
}

/// The scene as it is to look, of states that are what they are.
Identity looking_identity(const SceneDesc& scene, const render::Renderer& renderer, const RunPaths& source,
                          const Identity& there) {
  const Identity here = make_identity(scene, renderer.description());
  const Identity same_build(here.simulation(), here.picture(), there.simulation_build(),
                            here.picture_build());
  const std::vector<std::string> others = differences(there, same_build, false);
  if (!others.empty()) {
    refuse(fmt::format(
        "{}: its states are of another scene: {}; render changes only how they look, run or simulate "
        "with another --out makes others",
        source.root().string(), others.front()));
  }
  return same_build;
}

bool says_so_already(const RunPaths& paths, const Identity& wanted) {
  const RunContents contents = read_contents(paths, wanted);
  return contents.info && contents.info->identity.picture_hash() == wanted.picture_hash() &&
         contents.info->names == paths.names() && contents.other_pictures == 0;
}

/// A lock that others who draw the same run may share, or an exclusive one where RUN must be brought up to
/// date.
RunLock lock_for_drawing(const fs::path& root, const std::optional<std::string>& pattern,
                         const Identity& wanted) {
  constexpr double patience = 3.0;  // [s], for those who begin together
  const Stopwatch watch;
  RunLock lock(root);
  for (;;) {
    if (lock.try_take(RunLock::Kind::shared) && says_so_already(paths_of_run(root, pattern), wanted))
      return lock;
    if (lock.try_take(RunLock::Kind::exclusive)) return lock;
    if (watch.seconds() > patience) lock.take(RunLock::Kind::exclusive);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

/// Those asked for, or all whose states are there.
FrameRange frames_to_draw(const Options& options, const SceneDesc& scene, const StatesOfRun& states) {
  FrameRange frames = options.frames ? wanted_frames(options.frames, scene.time.frames) : states.all();
  frames.every = options.every;
  // Motion begins at the frame before.
  const int before = draws_motion(scene) ? 1 : 0;
  const int at_once = frames.every == 1 ? frames.last - frames.first : 0;
  for (int frame = frames.first; frame <= frames.last; frame += at_once + frames.every)
    states.require({std::max(frame - before, 0), frame + at_once});
  return frames;
}

/// Where all frames are asked for and not all have states.
void tell_missing_states(const Options& options, const SceneDesc& scene, const RunPaths& source,
                         const FrameRange& states, Progress& progress) {
  const int all = scene.time.frames;
  if (options.frames || (states.first == 0 && states.last + 1 == all)) return;
  progress.note(fmt::format("{}: draws frames {}..{} of {}, for the state of frame {} is not there",
                            source.root().string(), states.first, states.last, all,
                            states.first > 0 ? 0 : states.last + 1));
}

std::vector<FrameJob> missing_pictures(const RunPaths& paths, const RunContents& contents,
                                       const StatesOfRun& states, FrameRange frames) {
  std::vector<FrameJob> jobs;
  for (int frame = frames.first; frame <= frames.last; frame += frames.every) {
    const auto record = contents.matching.find(frame);
    const bool there = record != contents.matching.end() &&
                       record->second.state->sha256 == states.records().at(frame).sha256 &&
                       picture_is_there(paths, record->second);
    if (!there) jobs.push_back({.frame = frame, .simulate = false, .draw = true});
  }
  return jobs;
}

}  // namespace

ExitStatus render_command(const Options& options) {
  const StopSignals signals;
  Progress progress(options.quiet);
  const int threads = thread_count(options);
  const sim::ThreadLimit limit(threads);
  const RunPaths source(options.inputs.at(0));
  const RunInfo info = info_of(source);
  SceneDesc scene = load_scene_as_drawn(source.scene(), options.set, options);
  if (options.backend) scene.render.backend = *options.backend;
  check_camera(scene);  // told before all else
  std::unique_ptr<render::Renderer> renderer = render::make_renderer(scene.render, threads);
  const Identity identity = looking_identity(scene, *renderer, source, info.identity);
  const StatesOfRun states(source, info.identity, scene.time.frames);
  const FrameRange frames = frames_to_draw(options, scene, states);
  tell_missing_states(options, scene, source, states.all(), progress);

  const fs::path root = options.out.value_or(draft_folder(source.root(), options));
  std::error_code error;
  std::optional<RunLock> lock;
  if (fs::is_directory(root, error)) lock.emplace(lock_for_drawing(root, options.pattern, identity));
  const RunPaths paths = paths_of_run(root, options.pattern);
  RunContents contents = read_contents(paths, identity);
  if (!options.force) refuse_others(paths, contents, identity);
  std::vector<FrameJob> jobs = missing_pictures(paths, contents, states, frames);
  return produce({.options = options,
                  .scene = scene,
                  .paths = paths,
                  .identity = identity,
                  .renderer = std::move(renderer),
                  .contents = std::move(contents),
                  .jobs = std::move(jobs),
                  .frames = frames,
                  .threads = threads,
                  .lock = std::move(lock),
                  .share = true,
                  .states = &states},
                 progress);
}

}  // namespace lagomorph::apps
