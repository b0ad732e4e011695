#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lagomorph::apps {

/// Edits that turn `a` into `b`: insertions, deletions, substitutions and swaps of neighbours, whatever the
/// case of letters (optimal string alignment distance).
int edit_distance(std::string_view a, std::string_view b);

/// The known name nearest to what was written: at most a third of it differs, or one is a part of the other.
/// Empty when none is near.
std::string nearest(std::string_view written, std::span<const std::string> known);

/// "a, b, c".
std::string joined(std::span<const std::string> names);

}  // namespace lagomorph::apps
