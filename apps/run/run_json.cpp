#include "apps/run/run_json.h"

#include <sstream>

#include <toml++/toml.h>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/run/environment.h"
#include "apps/scene/scene.h"
#include "apps/version.h"

namespace lagomorph::apps {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

Json keys_json(const std::vector<ResolvedKey>& keys) {
  Json json = Json::object();
  for (const ResolvedKey& k : keys) json[k.key] = k.value;
  return json;
}

std::vector<ResolvedKey> keys_from(const Json& json) {
  std::vector<ResolvedKey> keys;
  for (const auto& [key, value] : json.items()) keys.push_back({key, value.get<std::string>()});
  return keys;
}

/// The resolved scene as JSON, by way of its own TOML.
Json scene_json(const SceneDesc& scene) {
  std::ostringstream text;
  text << toml::json_formatter(toml::parse(scene_to_toml(scene)));
  return Json::parse(text.str());
}

Json video_json(const VideoRecord& video) {
  return {{"file", video.file},
          {"first", video.first},
          {"last", video.last},
          {"source", video.source},
          {"sha256", video.sha256}};
}

}  // namespace

RunInfo make_run_info(const SceneDesc& scene, const Identity& identity, const std::string& renderer) {
  RunInfo info;
  info.identity = identity;
  info.about["lagomorph"] = version();
  info.about["name"] = scene.name;
  info.about["scene"] = scene_json(scene);
  info.about["mesh"] = nullptr;
  info.about["dependencies"] = dependency_versions(renderer);
  info.about["machine"] = machine_description();
  return info;
}

std::optional<RunInfo> read_run_info(const RunPaths& paths) {
  const fs::path file = paths.run_json();
  std::error_code error;
  if (!fs::exists(file, error)) return std::nullopt;
  try {
    Json json = Json::parse(read_file(file));
    RunInfo info;
    const Json& keys = json.at("keys");
    info.identity = Identity(keys_from(keys.at("simulation")), keys_from(keys.at("picture")),
                             keys_from(keys.at("simulation_build")), keys_from(keys.at("picture_build")));
    if (json.contains("video")) {
      const Json& video = json["video"];
      info.video = {video.at("file").get<std::string>(), video.at("first").get<int>(),
                    video.at("last").get<int>(), video.at("source").get<std::string>(),
                    video.at("sha256").get<std::string>()};
    }
    if (json.contains("pattern")) info.names = FrameNames(json["pattern"].get<std::string>());
    for (const char* made_again : {"hashes", "keys", "frames", "video", "pattern"}) json.erase(made_again);
    info.about = std::move(json);
    return info;
  } catch (const Json::exception& e) {
    throw Error(ExitStatus::wrong_input, file.string() + ": is not a run's run.json (" + e.what() +
                                             "); remove it, or give another folder with --out");
  }
}

RunPaths paths_of_run(const fs::path& root, const std::optional<std::string>& pattern) {
  if (pattern) return RunPaths(root, FrameNames(*pattern));
  const std::optional<RunInfo> info = read_run_info(RunPaths(root));
  return RunPaths(root, info ? info->names : FrameNames());
}

std::string run_json_text(const RunInfo& info, const std::map<int, FrameRecord>& frames) {
  const Identity& identity = info.identity;
  Json json = info.about;
  json["hashes"] = {{"simulation", identity.simulation_hash()}, {"picture", nullptr}};
  if (!identity.picture_build().empty()) json["hashes"]["picture"] = identity.picture_hash();
  json["keys"] = {{"simulation", keys_json(identity.simulation())},
                  {"picture", keys_json(identity.picture())},
                  {"simulation_build", keys_json(identity.simulation_build())},
                  {"picture_build", keys_json(identity.picture_build())}};
  if (info.names != FrameNames()) json["pattern"] = info.names.pattern();
  if (info.video) json["video"] = video_json(*info.video);
  json["frames"] = Json::array();
  for (const auto& [frame, record] : frames) {
    Json told = to_json(record);
    told.erase("newton");  // newton.csv has it
    json["frames"].push_back(std::move(told));
  }
  return json.dump(1) + "\n";
}

}  // namespace lagomorph::apps
