#include "render/hdr.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string_view>

#include "render/error.h"

namespace lagomorph::render {
namespace {

constexpr int largest_side = 32768;
constexpr std::size_t most_texels = std::size_t{1} << 27;

using Rgbe = std::array<unsigned char, 4>;

/// mantissa / 256 * 2^(exponent - 128); exponent 0 is black.
Color color_of(const Rgbe& p) {
  if (p[3] == 0) return Color::Zero();
  return std::ldexp(1.0F, p[3] - (128 + 8)) *
         Color(static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]));
}

class Reader {
public:
  explicit Reader(std::span<const unsigned char> bytes) : bytes_(bytes) {}

  HdrPicture read() {
    if (bytes_.empty()) fail("is empty");
    const std::string_view first = line();
    if (!first.starts_with("#?")) fail("is no Radiance picture: it does not begin with '#?RADIANCE'");
    read_header();
    HdrPicture picture;
    read_size(picture);
    const auto width = static_cast<std::size_t>(picture.width);
    std::vector<Rgbe> row(width);
    picture.texels.reserve(width * static_cast<std::size_t>(picture.height));
    for (row_ = 0; row_ < picture.height; ++row_) {
      read_row(row);
      for (const Rgbe& p : row) {
        const Color c = color_of(p) / exposure_;
        if (!c.isFinite().all()) fail("has a value that is not finite in row " + std::to_string(row_));
        picture.texels.push_back(c);
      }
    }
    return picture;
  }

private:
  [[noreturn]] static void fail(const std::string& what) { throw SettingsError(what); }

  unsigned char byte() {
    if (at_ == bytes_.size()) fail("ends in row " + std::to_string(row_) + ": it is truncated");
    return bytes_[at_++];
  }

  std::string_view line() {
    const std::size_t begin = at_;
    while (at_ < bytes_.size() && bytes_[at_] != '\n') ++at_;
    if (at_ == bytes_.size()) fail("ends in its header: it is truncated");
    const auto* const text = reinterpret_cast<const char*>(bytes_.data());
    std::string_view found(text + begin, at_++ - begin);
    if (found.ends_with('\r')) found.remove_suffix(1);
    return found;
  }

  void read_header() {
    for (std::string_view text = line(); !text.empty(); text = line()) {
      if (text.starts_with("FORMAT=") && text != "FORMAT=32-bit_rle_rgbe")
        fail("has the format '" + std::string(text.substr(7)) + "'; 32-bit_rle_rgbe is read");
      if (!text.starts_with("EXPOSURE=")) continue;
      const std::string_view digits = text.substr(text.find_first_not_of(' ', 9));
      float value = 0.0F;
      std::from_chars(digits.data(), digits.data() + digits.size(), value);
      if (!(value > 0.0F && std::isfinite(value)))
        fail("has the line '" + std::string(text) + "'; it must be > 0");
      exposure_ *= value;
    }
  }

  void read_size(HdrPicture& picture) {
    const std::string text(line());
    char junk = 0;
    if (std::sscanf(text.c_str(), "-Y %d +X %d%c", &picture.height, &picture.width, &junk) != 2)
      fail("has the size '" + text + "'; '-Y height +X width' is read");
    if (picture.width < 1 || picture.height < 1 || picture.width > largest_side ||
        picture.height > largest_side ||
        static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) > most_texels)
      fail("has " + std::to_string(picture.width) + "x" + std::to_string(picture.height) +
           " texels; each side must be in 1.." + std::to_string(largest_side) + ", with 2^27 in all");
  }

  void read_row(std::vector<Rgbe>& row) {
    const Rgbe head = {byte(), byte(), byte(), byte()};
    const bool encoded =
        head[0] == 2 && head[1] == 2 && (head[2] & 0x80) == 0 && row.size() >= 8 && row.size() <= 0x7fff;
    if (!encoded) return read_plain_row(head, row);
    if (static_cast<std::size_t>(head[2] << 8 | head[3]) != row.size())
      fail("has a row " + std::to_string(row_) + " of another width");
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t x = 0; x < row.size();) {
        const unsigned char code = byte();
        const std::size_t count = code > 128 ? code - 128U : code;
        if (count == 0 || x + count > row.size()) fail("has a run out of its row " + std::to_string(row_));
        const unsigned char same = code > 128 ? byte() : 0;
        for (std::size_t i = 0; i < count; ++i) row[x++][k] = code > 128 ? same : byte();
      }
    }
  }

  /// Texel by texel; (1, 1, 1, n) repeats the one before n times, n << 8 where two follow each other.
  void read_plain_row(Rgbe head, std::vector<Rgbe>& row) {
    int shift = 0;
    for (std::size_t x = 0;;) {
      if (head[0] == 1 && head[1] == 1 && head[2] == 1) {
        const std::size_t count = shift > 16 ? row.size() + 1 : static_cast<std::size_t>(head[3]) << shift;
        if (x == 0 || count > row.size() - x) fail("has a run out of its row " + std::to_string(row_));
        for (std::size_t i = 0; i < count; ++i, ++x) row[x] = row[x - 1];
        shift += 8;
      } else {
        row[x++] = head;
        shift = 0;
      }
      if (x == row.size()) return;
      head = {byte(), byte(), byte(), byte()};
    }
  }

  std::span<const unsigned char> bytes_;
  std::size_t at_ = 0;
  int row_ = 0;
  float exposure_ = 1.0F;
};

Rgbe rgbe_of(const Color& c) {
  const float largest = c.maxCoeff();
  if (!(largest > 1e-32F)) return {0, 0, 0, 0};
  int exponent = 0;
  std::frexp(largest, &exponent);
  if (std::ldexp(largest, 8 - exponent) >= 255.5F) ++exponent;  // rounds up to the next power of two
  Rgbe p{};
  for (int k = 0; k < 3; ++k)
    p[static_cast<std::size_t>(k)] = static_cast<unsigned char>(std::lround(std::ldexp(c[k], 8 - exponent)));
  p[3] = static_cast<unsigned char>(exponent + 128);
  return p;
}

void append_plane(std::string& out, const std::vector<Rgbe>& row, std::size_t k) {
  for (std::size_t x = 0; x < row.size();) {
    std::size_t same = 1;
    while (x + same < row.size() && same < 127 && row[x + same][k] == row[x][k]) ++same;
    if (same > 2) {
      out += static_cast<char>(128 + same);
      out += static_cast<char>(row[x][k]);
      x += same;
      continue;
    }
    std::size_t end = x + 1;  // where the next run of three begins
    while (end < row.size() && end - x < 128 &&
           !(end + 2 < row.size() && row[end][k] == row[end + 1][k] && row[end][k] == row[end + 2][k]))
      ++end;
    out += static_cast<char>(end - x);
    for (; x < end; ++x) out += static_cast<char>(row[x][k]);
  }
}

}  // namespace

HdrPicture read_hdr(std::span<const unsigned char> bytes) { return Reader(bytes).read(); }

std::string write_hdr(const HdrPicture& picture) {
  std::string out = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(picture.height) + " +X " +
                    std::to_string(picture.width) + "\n";
  const auto width = static_cast<std::size_t>(picture.width);
  std::vector<Rgbe> row(width);
  for (std::size_t y = 0; y < static_cast<std::size_t>(picture.height); ++y) {
    for (std::size_t x = 0; x < width; ++x) row[x] = rgbe_of(picture.texels[y * width + x]);
    if (width < 8 || width > 0x7fff) {
      for (const Rgbe& p : row) out.append(reinterpret_cast<const char*>(p.data()), 4);
      continue;
    }
    const std::array<char, 4> head = {2, 2, static_cast<char>(width >> 8), static_cast<char>(width & 0xff)};
    out.append(head.data(), 4);
    for (std::size_t k = 0; k < 4; ++k) append_plane(out, row, k);
  }
  return out;
}

}  // namespace lagomorph::render
