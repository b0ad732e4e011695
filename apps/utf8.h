#pragma once

#include <string>
#include <string_view>

namespace lagomorph::apps {

/// Whether the bytes are UTF-8 (RFC 3629: shortest forms only, no surrogates, up to U+10FFFF).
bool is_utf8(std::string_view bytes);

/// The bytes with U+FFFD in place of each that belongs to no character.
std::string valid_utf8(std::string_view bytes);

}  // namespace lagomorph::apps
