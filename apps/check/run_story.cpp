#include "apps/check/run_story.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "apps/error.h"
#include "apps/file_io.h"

namespace lagomorph::apps {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& frame, const char* key) {
  const auto at = frame.find(key);
  return at != frame.end() && at->is_string() ? at->get<std::string>() : std::string();
}

FrameStory frame_story(const Json& frame) {
  FrameStory story;
  story.state = text_of(frame, "state_sha256");
  story.state_shown = text_of(frame, "picture_of_state");
  story.state_made_by = text_of(frame, "state_made_by");
  story.picture_made_by = text_of(frame, "picture_made_by");
  if (const auto energy = frame.find("energy"); energy != frame.end()) {
    story.energy = {energy->at("kinetic").get<double>(), energy->at("elastic").get<double>(),
                    energy->at("gravitational").get<double>()};
  }
  return story;
}

}  // namespace

const FrameStory* RunStory::of(int frame) const {
  const auto at = frames.find(frame);
  return at == frames.end() ? nullptr : &at->second;
}

std::optional<RunStory> read_run_story(const std::filesystem::path& root) {
  RunPaths paths(root);
  try {
    std::optional<RunInfo> info = read_run_info(paths);
    if (!info) return std::nullopt;
    const Json json = Json::parse(read_file(paths.run_json()));
    RunStory story{std::move(paths), *std::move(info), text_of(json.at("hashes"), "picture"), {}};
    for (const Json& frame : json.at("frames"))
      story.frames[frame.at("frame").get<int>()] = frame_story(frame);
    return story;
  } catch (const Json::exception&) {
    // A run.json that another program wrote tells nothing, and is no judge of pictures.
  } catch (const Error& error) {
    if (error.status != ExitStatus::wrong_input) throw;
  }
  return std::nullopt;
}

}  // namespace lagomorph::apps
