#pragma once

#include <string>

#include "apps/check/result.h"

namespace lagomorph::apps {

/// What `version` of report.json is; another number is another meaning of its keys.
inline constexpr int report_version = 1;

/// RUN/check/report.json. Paths of heat and panels are relative to it; those of pictures as given.
std::string report_json(const CheckResult&);

}  // namespace lagomorph::apps
