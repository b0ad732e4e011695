#pragma once

#include <string>
#include <vector>

namespace lagomorph::apps {

/// "0..11, 13": ascending frames as ranges; "none".
std::string ranges_text(const std::vector<int>& frames);

}  // namespace lagomorph::apps
