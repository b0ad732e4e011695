#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/io/scanner.h"

namespace lagomorph::sim::io {

/// How a binary file holds a number.
enum class NumberType {
  kInt8,
  kUInt8,
  kInt16,
  kUInt16,
  kInt32,
  kUInt32,
  kInt64,
  kUInt64,
  kFloat32,
  kFloat64
};

constexpr std::size_t size_of(NumberType type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

constexpr bool is_integer(NumberType type) {
  return type != NumberType::kFloat32 && type != NumberType::kFloat64;
}

/// The next binary value as a double, finite.
double binary_number(Scanner&, NumberType, const char* what);
/// The next binary value as an integer; fails when it is none.
std::int64_t binary_integer(Scanner&, NumberType, const char* what);

}  // namespace lagomorph::sim::io
