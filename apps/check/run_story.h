#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "apps/run/paths.h"
#include "apps/run/run_json.h"

namespace lagomorph::apps {

/// What run.json tells of a frame.
struct FrameStory {
  std::string state;                            // sha-256 of its state; empty: not told
  std::string state_shown;                      // of the state that its picture shows; empty: not told
  std::string state_made_by, picture_made_by;   // hashes of identities; empty: not told
  std::optional<std::array<double, 3>> energy;  // kinetic, elastic, gravitational [J]
};

/// How pictures came about: of a run, or of the run that became a golden.
struct RunStory {
  RunPaths paths;  // states that were kept are there
  RunInfo info;
  std::string picture_hash;  // of what `info` tells; empty: not told
  std::map<int, FrameStory> frames;

  const FrameStory* of(int frame) const;
};

/// From ROOT/run.json; nullopt when there is none that can be read.
std::optional<RunStory> read_run_story(const std::filesystem::path& root);

}  // namespace lagomorph::apps
