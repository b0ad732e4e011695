#include "render/png_chunks.h"

#include <cstdint>

#include <libdeflate.h>

namespace lagomorph::render {
namespace {

constexpr std::string_view signature("\x89PNG\r\n\x1a\n", 8);
constexpr std::size_t frame_bytes = 12;  // of a chunk around its data: length, type, CRC

std::uint32_t big_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = (value << 8U) | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

std::string hex(std::uint32_t value, int digits) {
  constexpr char digit[] = "0123456789abcdef";
  std::string text;
  for (int i = digits - 1; i >= 0; --i) text += digit[(value >> static_cast<unsigned>(4 * i)) & 15U];
  return text;
}

struct Chunk {
  std::string_view type;
  std::string_view data;
};

class Walk {
public:
  Walk(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {
    if (bytes.empty()) fail("is empty; a PNG is expected");
    if (bytes.substr(0, signature.size()) == signature) return;
    if (signature.starts_with(bytes)) truncated("its signature");
    std::string start;
    for (const char c : bytes.substr(0, 4)) start += hex(static_cast<unsigned char>(c), 2) + ' ';
    start.pop_back();
    fail("is no PNG: it starts with " + start + ", not with 89 50 4e 47");
  }

  Chunk next() {
    if (bytes_.size() - at_ < frame_bytes) truncated("the next chunk");
    const std::size_t length = big_endian(bytes_, at_);
    const Chunk chunk{bytes_.substr(at_ + 4, 4), bytes_.substr(at_ + 8, length)};
    for (const char c : chunk.type) {
      if ((c < 'A' || c > 'Z') && (c < 'a' || c > 'z')) {
        fail("is damaged: no chunk begins at byte " + std::to_string(at_));
      }
    }
    if (bytes_.size() - at_ - frame_bytes < length) {
      truncated(std::string(chunk.type) + " of " + std::to_string(length) + " bytes");
    }
    const std::uint32_t stored = big_endian(bytes_, at_ + 8 + length);
    const std::uint32_t computed = libdeflate_crc32(0, bytes_.data() + at_ + 4, length + 4);
    if (stored != computed) {
      fail("is damaged: chunk " + std::string(chunk.type) + " at byte " + std::to_string(at_) + " has CRC " +
           hex(stored, 8) + ", its bytes give " + hex(computed, 8));
    }
    at_ += frame_bytes + length;
    return chunk;
  }

  [[noreturn]] void fail(const std::string& what) const { throw PictureError(name_ + ": " + what); }

private:
  [[noreturn]] void truncated(const std::string& in) const {
    fail("is truncated: it ends after " + std::to_string(bytes_.size()) + " bytes, within " + in);
  }

  std::string_view bytes_;
  const std::string& name_;
  std::size_t at_ = signature.size();
};

struct ColorType {
  unsigned code;
  int channels;  // stored
  int shown;     // after the palette
  bool alpha;
  unsigned depths;  // legal ones, as a sum: they are powers of two
};
constexpr ColorType color_types[] = {
    {0, 1, 1, false, 1 | 2 | 4 | 8 | 16},
    {2, 3, 3, false, 8 | 16},
    {3, 1, 3, false, 1 | 2 | 4 | 8},
    {4, 2, 2, true, 8 | 16},
    {6, 4, 4, true, 8 | 16},
};
constexpr unsigned palette_type = 3;

const ColorType& find_color_type(const Walk& walk, unsigned code, unsigned depth) {
  for (const ColorType& type : color_types) {
    if (type.code != code) continue;
    if ((type.depths & depth) == 0 || (depth & (depth - 1)) != 0) break;
    return type;
  }
  walk.fail("colour type " + std::to_string(code) + " of " + std::to_string(depth) +
            " bits is none of a PNG's");
}

void check_size(const Walk& walk, std::uint32_t width, std::uint32_t height) {
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  if (width == 0 || height == 0) walk.fail("its header claims " + size + " pixels; one at least is needed");
  if (std::uint64_t{width} * height > most_png_pixels) {
    walk.fail("its header claims " + size + " pixels; " + std::to_string(most_png_pixels) +
              " are the most that are read");
  }
}

}  // namespace

PngHeader read_png_header(std::string_view bytes, const std::string& name) {
  Walk walk(bytes, name);
  const Chunk first = walk.next();
  if (first.type != "IHDR" || first.data.size() != 13) walk.fail("does not begin with its header, IHDR");
  const std::uint32_t width = big_endian(first.data, 0);
  const std::uint32_t height = big_endian(first.data, 4);
  const auto byte = [&](std::size_t at) { return unsigned{static_cast<unsigned char>(first.data[at])}; };
  check_size(walk, width, height);
  const ColorType& type = find_color_type(walk, byte(9), byte(8));
  if (byte(10) != 0 || byte(11) != 0 || byte(12) > 1)
    walk.fail("its compression, filter or interlace method is unknown");

  PngHeader header{.width = static_cast<int>(width),
                   .height = static_cast<int>(height),
                   .bit_depth = type.code == palette_type ? 8 : static_cast<int>(byte(8)),
                   .channels = type.shown,
                   .alpha = type.alpha,
                   .interlaced = byte(12) == 1};
  bool palette = false;
  std::size_t compressed = 0;
  for (Chunk chunk = walk.next(); chunk.type != "IEND"; chunk = walk.next()) {
    if (chunk.type == "IHDR") walk.fail("has two headers, IHDR");
    if (chunk.type == "PLTE") palette = true;
    if (chunk.type == "IDAT") compressed += chunk.data.size();
    if (chunk.type == "tRNS" && !header.alpha) {
      header.alpha = true;
      ++header.channels;
    }
  }
  if (compressed == 0) walk.fail("holds no pixels: chunk IDAT is missing");
  if (type.code == palette_type && !palette) walk.fail("has colours by palette, and no palette (chunk PLTE)");
  // A byte of deflate makes 1032 at most [RFC 1951: a match of 258 bytes takes two bits at least].
  const std::uint64_t least =
      std::uint64_t{width} * height * byte(8) * static_cast<unsigned>(type.channels) / 8;
  if (least > 1032 * std::uint64_t{compressed}) {
    walk.fail("its header claims " + std::to_string(width) + "x" + std::to_string(height) +
              " pixels, more than its " + std::to_string(compressed) + " bytes of data can hold");
  }
  return header;
}

}  // namespace lagomorph::render
