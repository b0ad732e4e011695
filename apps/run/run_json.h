#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/frame_names.h"
#include "apps/run/identity.h"
#include "apps/run/paths.h"
#include "apps/run/record.h"
#include "apps/scene/scene_desc.h"

namespace lagomorph::apps {

/// What of a video makes it up to date: it is made again when its pictures, or its rate, are others.
struct VideoRecord {
  std::string file;  // name in RUN
  int first = 0;     // frames first..last
  int last = 0;
  std::string source;  // hash of the pictures and of how they were put together
  std::string sha256;  // of the file
};

/// RUN/run.json: what was run.
struct RunInfo {
  Identity identity;
  /// What else is told, in the order it is written: program, scene, mesh sizes, dependencies, machine.
  nlohmann::ordered_json about = nlohmann::ordered_json::object();
  std::optional<VideoRecord> video;
  FrameNames names;  // of the pictures
};

/// Everything of run.json that the scene and this program say; mesh sizes are added where a model is built.
RunInfo make_run_info(const SceneDesc&, const Identity&, const std::string& renderer);

/// nullopt when there is none. Throws Error(wrong_input) when it is not what this program writes.
std::optional<RunInfo> read_run_info(const RunPaths&);

/// Where the files of a run are: its pictures by the pattern that is given, or that its run.json tells, or as
/// usual. Throws as read_run_info() does.
RunPaths paths_of_run(const std::filesystem::path& root, const std::optional<std::string>& pattern = {});

/// run.json's text with these frames.
std::string run_json_text(const RunInfo&, const std::map<int, FrameRecord>& frames);

}  // namespace lagomorph::apps
