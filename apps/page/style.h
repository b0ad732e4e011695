#pragma once

#include <string_view>

namespace lagomorph::apps {

/// The look of every page that is made, light and dark, wide and on a phone.
extern const std::string_view page_style;

}  // namespace lagomorph::apps
