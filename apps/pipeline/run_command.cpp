#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/commands.h"
#include "apps/pipeline/production.h"
#include "apps/pipeline/stop.h"
#include "apps/progress/progress.h"
#include "apps/run/contents.h"
#include "apps/run/draft.h"
#include "apps/run/plan.h"
#include "apps/scene/find_scene.h"
#include "apps/scene/scene.h"
#include "render/renderer.h"
#include "sim/parallel.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

/// This program's identity. Who only simulates leaves the pictures' part as it is in RUN.
Identity identity_of(const SceneDesc& scene, const render::Renderer* renderer, const RunPaths& paths) {
  if (renderer != nullptr) return make_identity(scene, renderer->description());
  const Identity stepping = make_identity(scene, "");
  const std::optional<RunInfo> there = read_run_info(paths);
  if (!there) return stepping;
  return {stepping.simulation(), stepping.picture(), stepping.simulation_build(),
          there->identity.picture_build()};
}

std::optional<RunLock> lock_existing(const fs::path& root) {
  std::error_code error;
  if (!fs::is_directory(root, error)) return std::nullopt;
  RunLock lock(root);
  lock.take(RunLock::Kind::exclusive);
  return lock;
}

/// `--static` in terms of scene keys; more frames are equilibria of later loads.
std::vector<std::string> overrides(const Options& options) {
  std::vector<std::string> set = options.set;
  if (options.is_static) {
    set.insert(set.begin(), "time.frames=2");
    set.emplace_back("time.integrator=\"static\"");
  }
  return set;
}

ExitStatus run_scene(const Options& options, bool draws) {
  const StopSignals signals;
  Progress progress(options.quiet);
  const int threads = thread_count(options);
  const sim::ThreadLimit limit(threads);
  SceneDesc scene = load_scene_as_drawn(find_scene(options.inputs.at(0)), overrides(options), options);
  if (options.backend) scene.render.backend = *options.backend;
  FrameRange frames = wanted_frames(options.frames, scene.time.frames);
  frames.every = options.every;
  const fs::path root = options.out.value_or(draft_folder(fs::path("out") / scene.name, options));
  check_camera(scene);  // told before all else
  std::unique_ptr<render::Renderer> renderer;
  if (draws) renderer = render::make_renderer(scene.render, threads);

  std::optional<RunLock> lock = lock_existing(root);
  const RunPaths paths = paths_of_run(root, options.pattern);
  const Identity identity = identity_of(scene, renderer.get(), paths);
  RunContents contents = read_contents(paths, identity);
  if (!options.force) refuse_others(paths, contents, identity);
  std::vector<FrameJob> jobs =
      missing_frames(paths, contents.matching, frames.last, draws ? std::optional(frames) : std::nullopt);
  return produce({.options = options,
                  .scene = scene,
                  .paths = paths,
                  .identity = identity,
                  .renderer = std::move(renderer),
                  .contents = std::move(contents),
                  .jobs = std::move(jobs),
                  .frames = draws ? frames : FrameRange{0, frames.last},
                  .threads = threads,
                  .lock = std::move(lock)},
                 progress);
}

}  // namespace

ExitStatus run_command(const Options& options) { return run_scene(options, true); }
ExitStatus simulate_command(const Options& options) { return run_scene(options, false); }

}  // namespace lagomorph::apps
