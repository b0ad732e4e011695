#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lagomorph::apps {

/// The frames of whose pictures RUN/run.json tells another sha-256 than these files have. A run.json that
/// cannot be read tells nothing.
std::vector<int> pictures_unlike_run_json(const std::filesystem::path& run,
                                          const std::map<int, std::string>& sha256);

}  // namespace lagomorph::apps
