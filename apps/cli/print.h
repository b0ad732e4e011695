#pragma once

#include <string_view>

namespace lagomorph::apps {

/// Writes to stdout, with all that is buffered before it. A reader that left (`| head`) is no error. Throws
/// Error(machine) for any other failure.
void print(std::string_view text);

}  // namespace lagomorph::apps
