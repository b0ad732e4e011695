#include "sim/io/number_type.h"

#include <cmath>
#include <limits>

namespace lagomorph::sim::io {

std::int64_t binary_integer(Scanner& scanner, NumberType type, const char* what) {
  switch (type) {
    case NumberType::kInt8:
      return scanner.binary<std::int8_t>(what);
    case NumberType::kUInt8:
      return scanner.binary<std::uint8_t>(what);
    case NumberType::kInt16:
      return scanner.binary<std::int16_t>(what);
    case NumberType::kUInt16:
      return scanner.binary<std::uint16_t>(what);
    case NumberType::kInt32:
      return scanner.binary<std::int32_t>(what);
    case NumberType::kUInt32:
      return scanner.binary<std::uint32_t>(what);
    case NumberType::kInt64:
      return scanner.binary<std::int64_t>(what);
    case NumberType::kUInt64: {
      const auto value = scanner.binary<std::uint64_t>(what);
      if (value > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
        scanner.fail(std::string(what) + " is " + std::to_string(value) + ", out of range");
      }
      return static_cast<std::int64_t>(value);
    }
    case NumberType::kFloat32:
    case NumberType::kFloat64:
      break;
  }
  const double value = binary_number(scanner, type, what);
  if (value != std::floor(value) || std::abs(value) > 9e15)
    scanner.fail(std::string(what) + " is no integer");
  return static_cast<std::int64_t>(value);
}

double binary_number(Scanner& scanner, NumberType type, const char* what) {
  if (type == NumberType::kFloat64) return scanner.finite(scanner.binary<double>(what), what);
  if (type == NumberType::kFloat32)
    return scanner.finite(static_cast<double>(scanner.binary<float>(what)), what);
  return static_cast<double>(binary_integer(scanner, type, what));
}

}  // namespace lagomorph::sim::io
