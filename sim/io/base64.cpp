#include "sim/io/base64.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace lagomorph::sim::io {
namespace {

constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Values of the characters; -1 for those outside of the alphabet.
constexpr std::array<std::int8_t, 256> kValues = [] {
  std::array<std::int8_t, 256> values{};
  values.fill(-1);
  for (std::size_t i = 0; i < kAlphabet.size(); ++i) {
    values[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::int8_t>(i);
  }
  return values;
}();

int value_of(char c) { return kValues[static_cast<unsigned char>(c)]; }

}  // namespace

bool Base64Reader::read_quad() {
  std::uint32_t bits = 0;
  std::size_t digits = 0, padding = 0;
  while (digits + padding < 4) {
    if (position_ == text_.size()) return false;
    const char c = text_[position_++];
    if (c == ' ' || (c >= '\t' && c <= '\r')) continue;
    const int value = value_of(c);
    if (c == '=') {
      ++padding;
    } else if (value < 0 || padding > 0) {
      return false;
    } else {
      ++digits;
    }
    bits = bits << 6 | static_cast<std::uint32_t>(c == '=' ? 0 : value);
  }
  if (digits < 2) return false;
  for (int i = 0; i < 3; ++i) pending_[i] = static_cast<char>(bits >> (16 - 8 * i));
  pending_begin_ = 0;
  pending_end_ = digits - 1;
  return true;
}

bool Base64Reader::read(std::size_t size, std::string& bytes) {
  while (size > 0) {
    if (pending_begin_ == pending_end_ && !read_quad()) return false;
    const std::size_t taken = std::min(size, pending_end_ - pending_begin_);
    bytes.append(pending_ + pending_begin_, taken);
    pending_begin_ += taken;
    size -= taken;
  }
  return true;
}

std::string base64_encode(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    const std::size_t count = bytes.size() - i < 3 ? bytes.size() - i : 3;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (k < count ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kAlphabet[bits >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

}  // namespace lagomorph::sim::io
