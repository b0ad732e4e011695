#pragma once

#include <string>
#include <type_traits>

namespace lagomorph::sim::io {

/// Appends a value as the machine holds it, which is little-endian (see scanner.h).
template <typename T>
void append_bytes(std::string& bytes, const T& value) {
  static_assert(std::is_arithmetic_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

}  // namespace lagomorph::sim::io
