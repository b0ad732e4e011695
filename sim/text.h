#pragma once

#include <charconv>
#include <string>

#include "sim/types.h"

namespace lagomorph::sim {

/// A number for a message, six digits at most, whatever the locale.
inline std::string short_number(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 6).ptr};
}

/// "[x, y, z]", likewise.
inline std::string short_vector(const Vec3& v) {
  std::string text = "[";
  for (int k = 0; k < 3; ++k) text.append(short_number(v[k])).append(k < 2 ? ", " : "]");
  return text;
}

/// "1 tet", "2 tets".
inline std::string counted(long long n, const std::string& noun) {
  return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

}  // namespace lagomorph::sim
