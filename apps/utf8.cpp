#include "apps/utf8.h"

#include <cstddef>
#include <cstdint>

namespace lagomorph::apps {
namespace {

/// Bytes of the character that they begin with; 0 when they begin with none.
std::size_t character(std::string_view bytes) {
  const auto first = static_cast<unsigned char>(bytes[0]);
  const int more = first < 0x80   ? 0
                   : first < 0xC2 ? -1
                   : first < 0xE0 ? 1
                   : first < 0xF0 ? 2
                   : first < 0xF5 ? 3
                                  : -1;
  if (more < 0 || static_cast<std::size_t>(more) >= bytes.size()) return 0;
  std::uint32_t code = more == 0 ? first : first & (0x3FU >> more);
  for (int k = 1; k <= more; ++k) {
    const auto next = static_cast<unsigned char>(bytes[static_cast<std::size_t>(k)]);
    if ((next & 0xC0) != 0x80) return 0;
    code = code << 6 | (next & 0x3FU);
  }
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  const std::uint32_t least = more == 3 ? 0x10000 : more == 2 ? 0x800 : 0;
  if (surrogate || code < least || code > 0x10FFFF) return 0;
  return static_cast<std::size_t>(more) + 1;
}

}  // namespace

bool is_utf8(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t length = character(bytes);
    if (length == 0) return false;
    bytes.remove_prefix(length);
  }
  return true;
}

std::string valid_utf8(std::string_view bytes) {
  std::string text;
  while (!bytes.empty()) {
    const std::size_t length = character(bytes);
    if (length == 0) {
      text += "\xEF\xBF\xBD";  // U+FFFD
      bytes.remove_prefix(1);
    } else {
      text += bytes.substr(0, length);
      bytes.remove_prefix(length);
    }
  }
  return text;
}

}  // namespace lagomorph::apps
