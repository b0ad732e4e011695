#pragma once

#include <charconv>
#include <string>

namespace lagomorph::sim {

/// A number for a message, six digits at most, whatever the locale.
inline std::string short_number(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 6).ptr};
}

/// "1 tet", "2 tets".
inline std::string counted(long long n, const std::string& noun) {
  return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

}  // namespace lagomorph::sim
