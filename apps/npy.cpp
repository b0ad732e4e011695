#include "apps/npy.h"

#include <bit>
#include <cctype>
#include <charconv>
#include <cstring>
#include <optional>

#include <fmt/format.h>

#include "apps/error.h"

namespace lagomorph::apps {
namespace {

static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");

constexpr std::string_view magic("\x93NUMPY", 6);
constexpr std::size_t alignment = 64;

std::string header(std::string_view descr, std::span<const std::size_t> shape) {
  std::string text =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", descr, shape_text(shape));
  const std::size_t before = magic.size() + 4;
  text.append(alignment - (before + text.size() + 1) % alignment, ' ');
  text += '\n';
  std::string bytes(magic);
  bytes += {'\x01', '\x00', static_cast<char>(text.size() & 0xFF), static_cast<char>(text.size() >> 8)};
  return bytes + text;
}

template <class T>
std::string bytes_of(std::string_view descr, std::span<const T> values, std::span<const std::size_t> shape) {
  std::string bytes = header(descr, shape);
  const std::size_t start = bytes.size();
  bytes.resize(start + values.size_bytes());
  if (!values.empty()) std::memcpy(bytes.data() + start, values.data(), values.size_bytes());
  return bytes;
}

/// The few literals of Python that a header is made of.
class HeaderText {
public:
  explicit HeaderText(std::string_view text) : rest_(text) {}

  /// What follows `'key':`, without leading space; nullopt when there is no such key.
  std::optional<std::string_view> value(std::string_view key) const {
    const std::string quoted = fmt::format("'{}'", key);
    std::size_t at = rest_.find(quoted);
    if (at == std::string_view::npos) return std::nullopt;
    at = rest_.find_first_not_of(' ', at + quoted.size());
    if (at == std::string_view::npos || rest_[at] != ':') return std::nullopt;
    at = rest_.find_first_not_of(' ', at + 1);
    if (at == std::string_view::npos) return std::nullopt;
    return rest_.substr(at);
  }

private:
  std::string_view rest_;
};

std::optional<std::vector<std::size_t>> parse_shape(std::string_view text) {
  if (text.empty() || text.front() != '(') return std::nullopt;
  const std::size_t end = text.find(')');
  if (end == std::string_view::npos) return std::nullopt;
  std::vector<std::size_t> shape;
  std::string_view rest = text.substr(1, end - 1);
  while (!rest.empty()) {
    if (rest.front() == ' ' || rest.front() == ',') {
      rest.remove_prefix(1);
      continue;
    }
    std::size_t n = 0;
    const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), n);
    if (error != std::errc()) return std::nullopt;
    shape.push_back(n);
    rest.remove_prefix(static_cast<std::size_t>(stop - rest.data()));
  }
  return shape;
}

/// Number of values; nullopt when it does not fit.
std::optional<std::size_t> product(std::span<const std::size_t> shape) {
  std::size_t n = 1;
  for (const std::size_t s : shape) {
    if (__builtin_mul_overflow(n, s, &n)) return std::nullopt;
  }
  return n;
}

/// `type` is NumPy's name of T in the header, `words` that for people.
template <class Array, class T>
Array read_array(std::string_view bytes, const std::string& origin, const std::string& type,
                 const std::string& words) {
  const auto fail = [&](const std::string& what) -> Error {
    return {ExitStatus::wrong_input, origin + ": " + what};
  };
  if (!bytes.starts_with(magic)) throw fail("is no npy file: it must begin with \\x93NUMPY");
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const std::size_t length_size = bytes.size() > magic.size() && byte(magic.size()) == 1 ? 2 : 4;
  const std::size_t before = magic.size() + 2 + length_size;
  if (bytes.size() < before) throw fail("is truncated inside the npy header");
  if (byte(magic.size()) < 1 || byte(magic.size()) > 3) {
    throw fail("has npy format " + std::to_string(byte(magic.size())) + "; 1, 2 or 3 would be right");
  }
  std::size_t length = 0;
  for (std::size_t i = 0; i < length_size; ++i)
    length |= std::size_t{byte(before - length_size + i)} << 8 * i;
  if (length > bytes.size() - before) throw fail("is truncated inside the npy header");

  const HeaderText text(bytes.substr(before, length));
  const auto descr = text.value("descr");
  const auto order = text.value("fortran_order");
  const auto shape_value = text.value("shape");
  const auto shape = shape_value ? parse_shape(*shape_value) : std::nullopt;
  if (!descr || !order || !shape) throw fail("has an npy header that cannot be read");
  if (!descr->starts_with("'" + type + "'")) {
    throw fail("has values of type " + std::string(descr->substr(0, descr->find(','))) + "; '" + type +
               "' would be right");
  }
  if (!order->starts_with("False")) throw fail("is in Fortran order; C order would be right");

  const std::optional<std::size_t> count = product(*shape);
  const std::size_t there = bytes.size() - before - length;
  if (!count || *count > there / sizeof(T) || there != *count * sizeof(T)) {
    throw fail("has " + std::to_string(there) + " bytes of values, which is not what the shape " +
               shape_text(*shape) + " of " + words + " needs");
  }
  Array array{*shape, std::vector<T>(*count)};
  if (*count > 0) std::memcpy(array.values.data(), bytes.data() + before + length, there);
  return array;
}

}  // namespace

std::string shape_text(std::span<const std::size_t> shape) {
  return fmt::format("({}{})", fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
}

std::string npy_bytes(std::span<const double> values, std::span<const std::size_t> shape) {
  return bytes_of("<f8", values, shape);
}

std::string npy_bytes(std::span<const float> values, std::span<const std::size_t> shape) {
  return bytes_of("<f4", values, shape);
}

NpyArray read_npy(std::string_view bytes, const std::string& origin) {
  return read_array<NpyArray, double>(bytes, origin, "<f8", "float64");
}

NpyFloats read_npy_floats(std::string_view bytes, const std::string& origin) {
  return read_array<NpyFloats, float>(bytes, origin, "<f4", "float32");
}

}  // namespace lagomorph::apps
