#pragma once

#include <charconv>
#include <concepts>
#include <string>
#include <string_view>
#include <utility>

namespace lagomorph::sim::io {

/// Text of a mesh file: numbers whatever the locale, doubles with 17 significant digits, so that they read
/// back the same.
class TextWriter {
public:
  TextWriter& operator<<(std::string_view text) {
    text_ += text;
    return *this;
  }
  TextWriter& operator<<(char c) {
    text_ += c;
    return *this;
  }
  TextWriter& operator<<(std::integral auto value) {
    char buffer[24];
    append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
    return *this;
  }
  TextWriter& operator<<(double value) {
    char buffer[32];
    append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 17).ptr);
    return *this;
  }
  /// Numbers with blanks between, and a line end.
  template <typename... Values>
  void line(const Values&... values) {
    ((*this << values << ' '), ...);
    text_.back() = '\n';
  }
  std::string take() { return std::move(text_); }

private:
  void append(const char* begin, const char* end) {
    text_.append(begin, static_cast<std::size_t>(end - begin));
  }

  std::string text_;
};

}  // namespace lagomorph::sim::io
