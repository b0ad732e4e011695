#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/check/picture_folder.h"
#include "apps/cli/options.h"
#include "apps/run/record.h"
#include "apps/run/run_json.h"

namespace lagomorph::apps {

/// What a folder holds that a preview can show.
struct PreviewMaterial {
  std::filesystem::path run;  // as it was given
  std::string name;           // the scene's, or the folder's
  /// run.json; none: a folder of PNGs that Lagomorph did not make, so no energies.
  std::optional<RunInfo> info;
  std::map<int, std::filesystem::path> pictures;  // by frame
  std::map<int, FrameRecord> records;             // by frame; only those with a state
  int scene_frames = 0;                           // time.frames; 0 without a scene
  double fps = 30.0;                              // the scene's [1/s]; without one assumed
  std::string integrator;                         // the scene's
  std::string scene;                              // text of scene.toml; empty: none
  std::vector<std::string> remarks;               // what is not as one would expect, a line each
};

/// Reads a run, or a folder of numbered PNGs; of `frames` alone when they are given. Throws
/// Error(wrong_input) when there is nothing to show.
PreviewMaterial read_material(const std::filesystem::path& run, const std::optional<FrameRange>& frames);

/// How many of the pictures there are to a second of the scene: fewer than its frames where only every
/// so-many-th is drawn. [1/s]
double picture_rate(const PreviewMaterial&);

/// The numbers that frames go by in a map.
std::vector<int> frame_numbers(const auto& frames) {
  std::vector<int> all;
  all.reserve(frames.size());
  for (const auto& frame : frames) all.push_back(frame.first);
  return all;
}

}  // namespace lagomorph::apps
