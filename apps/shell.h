#pragma once

#include <string>
#include <string_view>

namespace lagomorph::apps {

/// The text as one word of a POSIX shell: as it is where that is safe, otherwise in single quotes.
std::string shell_word(std::string_view text);

}  // namespace lagomorph::apps
