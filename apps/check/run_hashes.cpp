#include "apps/check/run_hashes.h"

#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "apps/error.h"
#include "apps/file_io.h"

namespace lagomorph::apps {

std::vector<int> pictures_unlike_run_json(const std::filesystem::path& run,
                                          const std::vector<FrameResult>& frames) {
  std::vector<int> unlike;
  std::error_code none;
  if (!std::filesystem::exists(run / "run.json", none)) return unlike;
  try {
    std::map<int, std::string> sha256;
    for (const FrameResult& frame : frames) {
      if (!frame.fresh_sha256.empty()) sha256[frame.frame] = frame.fresh_sha256;
    }
    const auto json = nlohmann::json::parse(read_file(run / "run.json"));
    for (const auto& frame : json.at("frames")) {
      const auto file = sha256.find(frame.at("frame").get<int>());
      if (file == sha256.end() || !frame.contains("picture_sha256")) continue;
      if (frame.at("picture_sha256").get<std::string>() != file->second) unlike.push_back(file->first);
    }
  } catch (const nlohmann::json::exception&) {
    // It is no judge of pictures.
  } catch (const Error&) {
  }
  return unlike;
}

}  // namespace lagomorph::apps
