#pragma once

#include <string>

namespace lagomorph::apps {

/// Version of the program, "0.1.0".
std::string version();

}  // namespace lagomorph::apps
