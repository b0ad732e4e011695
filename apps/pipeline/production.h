#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "apps/cli/options.h"
#include "apps/error.h"
#include "apps/progress/progress.h"
#include "apps/run/contents.h"
#include "apps/run/identity.h"
#include "apps/run/lock.h"
#include "apps/run/paths.h"
#include "apps/run/plan.h"
#include "apps/run/states_of_run.h"
#include "apps/run/video_ahead.h"
#include "apps/scene/scene_desc.h"
#include "render/renderer.h"

namespace lagomorph::apps {

/// What a command wants made, and where.
struct Production {
  const Options& options;
  const SceneDesc& scene;  // resolved; its files where they are now
  const RunPaths& paths;
  const Identity& identity;
  std::unique_ptr<render::Renderer> renderer;  // nullptr: nothing is drawn
  RunContents contents;                        // what RUN holds
  std::vector<FrameJob> jobs;                  // what is missing, in order
  FrameRange frames;                           // those asked for
  int threads;
  /// RUN's, when it is there. Exclusive: what RUN says of itself is brought up to date. Shared: it is so
  /// already, and others may draw frames of theirs.
  std::optional<RunLock> lock;
  bool share = false;                      // once it is brought up to date
  const StatesOfRun* states = nullptr;     // those to draw, when none are simulated
  std::unique_ptr<VideoAhead> video = {};  // encoded while pictures are made
};

/// Makes what is missing in RUN, and tells what was done: the part that run, simulate and render have in
/// common. Throws as its parts do; nothing is written then, or records are whole and run.json tells of them.
ExitStatus produce(Production, Progress&);

/// Throws render::SettingsError for a camera that is none.
void check_camera(const SceneDesc&);

/// `--threads`, or as many as the process may use.
int thread_count(const Options&);

}  // namespace lagomorph::apps
