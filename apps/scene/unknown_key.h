#pragma once

#include <string>
#include <vector>

namespace lagomorph::apps {

/// What is likely meant by a key that is not known where it stands: "did you mean 'young'?". `where` is how
/// the place is called, as in "known in [time] are ...".
std::string unknown_key_hint(const std::string& name, const std::vector<std::string>& known_here,
                             const std::string& where);

}  // namespace lagomorph::apps
