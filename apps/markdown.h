#pragma once

#include <string>
#include <string_view>

namespace lagomorph::apps {

/// A text as plain words of Markdown, on one line: in a paragraph, a heading or a cell of a table it has no
/// other meaning.
std::string markdown_text(std::string_view text);

}  // namespace lagomorph::apps
