#pragma once

#include <string>

#include "apps/scene/document.h"
#include "apps/scene/keys.h"

namespace lagomorph::apps {

/// Reads a key's value, of the type, in the range and among the choices that are right for it. Throws
/// Error(wrong_input) with place, value and what would be right.
void read_value(const Document&, const Key&, const std::string& path, const toml::node&, Field);

/// What was found, in words: "the string "a"", "2.5", "an array".
std::string told(const toml::node&);

}  // namespace lagomorph::apps
