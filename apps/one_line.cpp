#include "apps/one_line.h"

namespace lagomorph::apps {
namespace {

void append_escaped(std::string& line, unsigned char c) {
  constexpr char digits[] = "0123456789abcdef";
  line += "\\x";
  line += digits[c >> 4];
  line += digits[c & 15];
}

}  // namespace

std::string one_line(std::string_view text) {
  std::string line;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    if (c == '\n') {
      line += "\\n";
    } else if (c == '\t') {
      line += "\\t";
    } else if (c == '\r') {
      line += "\\r";
    } else if (c < 0x20 || c == 0x7F) {
      append_escaped(line, c);
    } else if (c == 0xC2 && next >= 0x80 && next < 0xA0) {  // C1 control characters in UTF-8
      append_escaped(line, c);
      append_escaped(line, next);
      ++i;
    } else {
      line += text[i];
    }
  }
  return line;
}

}  // namespace lagomorph::apps
