#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "sim/io/file.h"

namespace lagomorph::sim::io {

static_assert(std::endian::native == std::endian::little,
              "binary meshes are read and written on little-endian machines");

/// Reads a file front to back, as blank-separated text or as binary values, whatever the locale. Errors are
/// InputErrors at the place of what was read last: `path:line: message` in text, `path: byte offset: message`
/// in binary. `what` arguments name what is expected, for those errors ("a coordinate").
class Scanner {
public:
  /// `file` must outlive the scanner. In text, `comment` and all that follows it on its line is blank (0: no
  /// comments).
  explicit Scanner(const File& file, char comment = '\0') : Scanner(file.bytes, file.path, comment) {}
  Scanner(std::string_view bytes, const std::string& path, char comment = '\0')
      : bytes_(bytes), path_(path), comment_(comment) {}

  /// Text. Blanks are spaces, tabs, line ends.
  bool at_end();                             // nothing but blanks and comments is left
  std::string_view token(const char* what);  // the next word; fails at the end of the file
  std::string_view peek();                   // the same without taking it; empty at the end
  double number(const char* what);           // finite; digits that underflow are 0
  std::int64_t integer(const char* what);
  void expect(std::string_view word);  // takes the next token and fails when it is another

  /// Text, line by line.
  bool at_line_end();               // only blanks and a comment are left on this line
  void skip_line();                 // to the start of the next line
  std::string_view rest_of_line();  // taken, without its line end
  void expect_line_end(const char* after);

  /// A number of things of at least `min_bytes` each, checked against what is left of the file before anybody
  /// allocates.
  std::size_t count(const char* what, std::size_t min_bytes);
  std::size_t check_count(std::int64_t n, const char* what, std::size_t min_bytes);
  /// An index in base .. base + size - 1, made 0-based.
  int index(const char* what, std::int64_t base, std::size_t size);
  int check_index(std::int64_t i, const char* what, std::int64_t base, std::size_t size);
  /// A region number as a tag of 32 bits.
  int check_tag(std::int64_t tag);

  /// Binary. From now on errors tell byte offsets; values have their bytes reversed when `swap`.
  void set_binary(bool swap) { binary_ = true, swap_ = swap; }
  void set_text() { binary_ = false; }
  bool swapped() const { return swap_; }
  template <typename T>
  T binary(const char* what) {
    require(sizeof(T), what);
    unsigned char raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + position_, sizeof(T));
    if (swap_) {
      for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(raw[i], raw[sizeof(T) - 1 - i]);
    }
    T value;
    std::memcpy(&value, raw, sizeof(T));
    position_ += sizeof(T);
    return value;
  }
  double finite(double value, const char* what);  // fails at the value just read when it is not
  void skip(std::size_t size, const char* what);
  void require(std::size_t size, const char* what);  // that many bytes are left

  std::size_t position() const { return position_; }
  void seek(std::size_t position) { position_ = start_ = position; }
  std::size_t left() const { return bytes_.size() - position_; }
  std::string_view bytes() const { return bytes_; }
  const std::string& path() const { return path_; }

  /// Fails at what was read last.
  [[noreturn]] void fail(const std::string& message) const;

private:
  void skip_blanks();
  std::size_t word_end(std::size_t from) const;
  [[noreturn]] void fail_number(const char* what, bool integer);

  std::string_view bytes_;
  std::string path_;
  char comment_;
  bool binary_ = false;
  bool swap_ = false;
  std::size_t position_ = 0;
  std::size_t start_ = 0;  // of what was read last
};

/// 'text' for an error message: in quotes, shortened, unprintable bytes as '?'.
std::string in_quotes(std::string_view text);

}  // namespace lagomorph::sim::io
