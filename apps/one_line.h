#pragma once

#include <string>
#include <string_view>

namespace lagomorph::apps {

/// The text on one line: control characters (line breaks, escape sequences, U+0080 to U+009F) are escaped as
/// \n, \t, \r or \xNN, so that a file's name or contents cannot break a message or a terminal.
std::string one_line(std::string_view text);

}  // namespace lagomorph::apps
