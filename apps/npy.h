#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// NumPy's file format: a header that a literal of Python describes, then the values, C order, little-endian.
namespace lagomorph::apps {

/// The values as a file of format 1.0. The product of the shape is the number of values.
std::string npy_bytes(std::span<const double> values, std::span<const std::size_t> shape);  // <f8
std::string npy_bytes(std::span<const float> values, std::span<const std::size_t> shape);   // <f4

struct NpyArray {
  std::vector<std::size_t> shape;
  std::vector<double> values;  // C order
};

/// Reads a float64 array in C order (formats 1 to 3). Throws Error(wrong_input) that names `origin`, what
/// stands there and what would be right: no npy file, another type or order, too few or too many bytes for
/// the shape.
NpyArray read_npy(std::string_view bytes, const std::string& origin);

struct NpyFloats {
  std::vector<std::size_t> shape;
  std::vector<float> values;  // C order
};
/// Likewise a float32 array.
NpyFloats read_npy_floats(std::string_view bytes, const std::string& origin);

/// "(1, 2, 27, 3)"
std::string shape_text(std::span<const std::size_t> shape);

}  // namespace lagomorph::apps
