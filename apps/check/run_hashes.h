#pragma once

#include <filesystem>
#include <vector>

#include "apps/check/result.h"

namespace lagomorph::apps {

/// The frames of whose pictures RUN/run.json tells another sha-256 than these files have. A run.json that
/// cannot be read tells nothing.
std::vector<int> pictures_unlike_run_json(const std::filesystem::path& run,
                                          const std::vector<FrameResult>& frames);

}  // namespace lagomorph::apps
