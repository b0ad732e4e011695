#include "sim/io/scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "sim/error.h"

namespace lagomorph::sim::io {
namespace {

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

std::string in_quotes(std::string_view text) {
  std::string result = "'";
  for (const char c : text.substr(0, 40)) result += c >= ' ' && c <= '~' ? c : '?';
  return result + (text.size() > 40 ? "...'" : "'");
}

void Scanner::skip_blanks() {
  while (position_ < bytes_.size()) {
    const char c = bytes_[position_];
    if (is_blank(c)) {
      ++position_;
    } else if (c == comment_ && comment_ != '\0') {
      skip_line();
    } else {
      return;
    }
  }
}

std::size_t Scanner::word_end(std::size_t from) const {
  while (from < bytes_.size() && !is_blank(bytes_[from]) && (bytes_[from] != comment_ || comment_ == '\0'))
    ++from;
  return from;
}

bool Scanner::at_end() {
  skip_blanks();
  return position_ == bytes_.size();
}

std::string_view Scanner::peek() {
  skip_blanks();
  start_ = position_;
  return bytes_.substr(position_, word_end(position_) - position_);
}

std::string_view Scanner::token(const char* what) {
  const std::string_view word = peek();
  if (word.empty()) fail(std::string("the file ends where ") + what + " should be");
  position_ += word.size();
  return word;
}

void Scanner::expect(std::string_view word) {
  const std::string_view found = token(std::string(word).c_str());
  if (found != word) fail("expected '" + std::string(word) + "', found " + in_quotes(found));
}

void Scanner::fail_number(const char* what, bool integer) {
  std::string_view word = peek();
  if (word.empty()) fail(std::string("the file ends where ") + what + " should be");
  std::string lower(word);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  const std::string_view unsigned_word =
      std::string_view(lower).substr(lower[0] == '-' || lower[0] == '+' ? 1 : 0);
  if (unsigned_word.starts_with("nan") || unsigned_word.starts_with("inf")) {
    fail(in_quotes(word) + " is not finite; " + what + " must be");
  }
  const bool starts_as_number =
      !unsigned_word.empty() &&
      (unsigned_word[0] == '.' || (unsigned_word[0] >= '0' && unsigned_word[0] <= '9'));
  if (starts_as_number && unsigned_word.find('d') != std::string_view::npos) {
    fail(in_quotes(word) + " has Fortran's exponent D; numbers are written as 1.0E+00");
  }
  if (starts_as_number && unsigned_word.find(',') != std::string_view::npos) {
    fail(in_quotes(word) + " has a comma; numbers are written with a decimal point");
  }
  fail("expected " + std::string(what) + (integer ? " (an integer), found " : " (a number), found ") +
       in_quotes(word));
}

double Scanner::number(const char* what) {
  skip_blanks();
  start_ = position_;
  const char* begin = bytes_.data() + position_;
  const char* end = bytes_.data() + bytes_.size();
  if (begin != end && *begin == '+') ++begin;
  double value = 0.0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  const auto stop_position = static_cast<std::size_t>(stop - bytes_.data());
  if (error == std::errc::invalid_argument || stop_position != word_end(stop_position))
    fail_number(what, false);
  if (error == std::errc::result_out_of_range) {
    // Too large or too small? The exponent's sign tells; digits alone underflow only with a point.
    const std::string_view word(begin, static_cast<std::size_t>(stop - begin));
    const std::size_t exponent = word.find_first_of("eE");
    const bool small = exponent == std::string_view::npos ? word.find('.') < 3 : word[exponent + 1] == '-';
    if (!small) fail(in_quotes(word) + " is out of range for a double");
    value = 0.0;
  }
  if (!std::isfinite(value)) fail_number(what, false);
  position_ = stop_position;
  return value;
}

std::int64_t Scanner::integer(const char* what) {
  skip_blanks();
  start_ = position_;
  const char* begin = bytes_.data() + position_;
  const char* end = bytes_.data() + bytes_.size();
  if (begin != end && *begin == '+') ++begin;
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  const auto stop_position = static_cast<std::size_t>(stop - bytes_.data());
  if (error != std::errc() || stop_position != word_end(stop_position)) fail_number(what, true);
  position_ = stop_position;
  return value;
}

bool Scanner::at_line_end() {
  while (position_ < bytes_.size() && is_blank(bytes_[position_]) && bytes_[position_] != '\n') ++position_;
  return position_ == bytes_.size() || bytes_[position_] == '\n' ||
         (bytes_[position_] == comment_ && comment_ != '\0');
}

void Scanner::skip_line() {
  const std::size_t end = bytes_.find('\n', position_);
  position_ = end == std::string_view::npos ? bytes_.size() : end + 1;
}

std::string_view Scanner::rest_of_line() {
  start_ = position_;
  std::string_view line = bytes_.substr(position_, bytes_.find('\n', position_) - position_);
  skip_line();
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  return line;
}

void Scanner::expect_line_end(const char* after) {
  if (!at_line_end()) fail("unexpected " + in_quotes(peek()) + " after " + after);
}

std::size_t Scanner::check_count(std::int64_t n, const char* what, std::size_t min_bytes) {
  if (n < 0)
    fail("the number of " + std::string(what) + " is " + std::to_string(n) + "; it cannot be negative");
  // The last item of a text may lack its line end, hence the 1.
  const auto count = static_cast<std::uint64_t>(n);
  if (count > (left() + 1) / min_bytes) {
    fail("the number of " + std::string(what) + " is " + std::to_string(n) + ", more than the " +
         std::to_string(left()) + " bytes that follow can hold; the file is cut short or its count is wrong");
  }
  // Unknowns are numbered by int, three a vertex.
  if (count > std::numeric_limits<int>::max() / 3) {
    fail("the number of " + std::string(what) + " is " + std::to_string(n) + "; at most " +
         std::to_string(std::numeric_limits<int>::max() / 3) + " can be used");
  }
  return static_cast<std::size_t>(n);
}

std::size_t Scanner::count(const char* what, std::size_t min_bytes) {
  return check_count(integer((std::string("the number of ") + what).c_str()), what, min_bytes);
}

int Scanner::check_index(std::int64_t i, const char* what, std::int64_t base, std::size_t size) {
  if (i < base || i - base >= static_cast<std::int64_t>(size)) {
    fail(std::string(what) + " is " + std::to_string(i) + "; it must be in " + std::to_string(base) + ".." +
         std::to_string(base + static_cast<std::int64_t>(size) - 1));
  }
  return static_cast<int>(i - base);
}

int Scanner::check_tag(std::int64_t tag) {
  if (tag < std::numeric_limits<int>::min() || tag > std::numeric_limits<int>::max()) {
    fail("the region number " + std::to_string(tag) + " does not fit 32 bits");
  }
  return static_cast<int>(tag);
}

int Scanner::index(const char* what, std::int64_t base, std::size_t size) {
  return check_index(integer(what), what, base, size);
}

void Scanner::require(std::size_t size, const char* what) {
  start_ = position_;
  if (size > left()) {
    fail("the file ends within " + std::string(what) + ": " + std::to_string(size) + " bytes are needed, " +
         std::to_string(left()) + " are left");
  }
}

void Scanner::skip(std::size_t size, const char* what) {
  require(size, what);
  position_ += size;
}

double Scanner::finite(double value, const char* what) {
  if (!std::isfinite(value))
    fail(std::string(what) + " is " + (std::isnan(value) ? "nan" : "infinite") + "; it must be finite");
  return value;
}

void Scanner::fail(const std::string& message) const {
  const std::size_t place = std::min(start_, bytes_.size());
  if (binary_) throw InputError(path_ + ": byte " + std::to_string(place) + ": " + message);
  const auto line = 1 + std::count(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(place), '\n');
  throw InputError(path_ + ":" + std::to_string(line) + ": " + message);
}

}  // namespace lagomorph::sim::io
