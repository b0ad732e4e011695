#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "apps/scene/keys.h"

namespace lagomorph::apps {

/// A value as TOML; parsing it gives the same value. None for an optional one that is not given.
std::optional<std::string> toml_value(const Field&);

/// A string as TOML's basic string.
std::string toml_string(std::string_view);

}  // namespace lagomorph::apps
