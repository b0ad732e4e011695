#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "sim/profile.h"

namespace lagomorph::apps {

/// Seconds of each stage that ran: {"gradient": 0.12, ...}.
nlohmann::ordered_json stage_seconds(const sim::Profile&);

/// The same to look at, with the share of the whole time that each stage's thread had: `seconds`. Ends with a
/// newline.
std::string profile_table(const sim::Profile&, double seconds);

}  // namespace lagomorph::apps
