#pragma once

#include <string>
#include <string_view>

namespace lagomorph::apps {

/// A text as text of HTML, in an element or a quoted attribute.
std::string html_text(std::string_view text);

/// A picture as a URI that holds it: "data:image/webp;base64,...".
std::string data_uri(std::string_view type, std::string_view bytes);

}  // namespace lagomorph::apps
