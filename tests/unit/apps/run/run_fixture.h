#pragma once

#include <map>
#include <string>
#include <vector>

#include "apps/file_io.h"
#include "apps/hash.h"
#include "apps/run/identity.h"
#include "apps/run/paths.h"
#include "apps/run/record.h"
#include "apps/run/run_json.h"

/// Runs made by hand, for the tests of what reads them.
namespace lagomorph::apps {

inline Identity some_identity(const std::string& density = "1000.0", const std::string& fov = "35.0",
                              const std::string& build = "\"a\"") {
  return {{{"body.0.density", density}, {"time.fps", "30.0"}},
          {{"camera.fov", fov}},
          {{"build.simulation", build}},
          {{"build.program", build}}};
}

/// A record whose every number differs.
inline FrameRecord some_record(int frame, const Identity& of = some_identity(), bool with_picture = true) {
  FrameRecord record;
  record.frame = frame;
  StateRecord& state = record.state.emplace();
  state.sha256 = sha256("state " + std::to_string(frame));
  state.made_by = of.state_maker();
  state.time = frame / 30.0;
  state.energy = {0.1 + frame, 0.25, -0.5};
  state.mass = 24.0;
  state.momentum = {1.5, -2.5, 1.0 / 3.0};
  state.angular_momentum = {-0.5, 0.25, 2.0 / 3.0};
  state.min_J = 0.875;
  state.report.pin_forces = {{1.0 / 7.0, 2.0, 3.0}, {4.0, 5.0, -6.0}};
  state.report.work_pins = 0.1 * frame;
  state.report.work_loads = -0.3;
  state.report.steps = 4;
  state.report.rejected = 2;
  state.report.halvings = 1;
  state.report.damping_loss = 0.125;
  state.report.error = 1e-5;
  state.report.newton_iterations = 17;
  state.report.residual = 1e-9;
  state.report.hit_rounding_floor = true;
  state.seconds = 0.25;
  if (!with_picture) return record;
  PictureRecord& picture = record.picture.emplace();
  picture.sha256 = sha256("picture " + std::to_string(frame));
  picture.made_by = of.picture_hash();
  picture.of_state = state.sha256;
  picture.channels = {{"depth", sha256("depth " + std::to_string(frame))}};
  picture.ranges = {{"bar", {-0.1, 1.0 / 3.0}}};
  picture.rendering_seconds = 0.5;
  picture.writing_seconds = 0.125;
  return record;
}

/// Writes the frame's record and the files that it tells of.
inline void write_frame(const RunPaths& paths, const FrameRecord& record) {
  for (const auto& folder : {paths.states(), paths.pictures(), paths.records(), paths.channel("depth")}) {
    make_folder(folder);
  }
  const std::string n = std::to_string(record.frame);
  if (record.state) write_file(paths.state(record.frame), "state " + n);
  if (record.picture) {
    write_file(paths.picture(record.frame), "picture " + n);
    write_file(paths.channel("depth", record.frame), "depth " + n);
  }
  write_record(paths, record);
}

/// A run of some frames.
inline void write_run(const RunPaths& paths, int frames, const Identity& of = some_identity()) {
  make_folder(paths.root());
  RunInfo info;
  info.identity = of;
  write_file(paths.run_json(), run_json_text(info, {}));
  for (int frame = 0; frame < frames; ++frame) write_frame(paths, some_record(frame, of));
}

}  // namespace lagomorph::apps
