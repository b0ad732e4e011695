#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lagomorph::sim::io {

/// Base64 (RFC 4648) read piece by piece. Padding may stand in the middle, where VTK's files join separately
/// encoded parts.
class Base64Reader {
public:
  explicit Base64Reader(std::string_view text) : text_(text) {}
  /// Appends the next `size` bytes; false when the text ends or has another character before.
  bool read(std::size_t size, std::string& bytes);

private:
  bool read_quad();

  std::string_view text_;
  std::size_t position_ = 0;
  char pending_[3] = {};  // decoded, not yet taken
  std::size_t pending_begin_ = 0, pending_end_ = 0;
};

std::string base64_encode(std::string_view bytes);

}  // namespace lagomorph::sim::io
