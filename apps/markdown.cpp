#include "apps/markdown.h"

#include "apps/one_line.h"

namespace lagomorph::apps {

std::string markdown_text(std::string_view text) {
  std::string out;
  for (const char c : one_line(text)) {
    if (std::string_view("|`*_[]\\#").find(c) != std::string_view::npos) out += '\\';
    if (c == '<') {
      out += "&lt;";
    } else if (c == '&') {
      out += "&amp;";
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace lagomorph::apps
