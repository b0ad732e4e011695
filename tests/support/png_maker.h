#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// Makes PNG files of every kind, plainly: no filter, stored (uncompressed) deflate blocks, its own
/// checksums. Shares no code with what reads them.
namespace lagomorph::tests {

inline void append_big_endian(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>((value >> shift) & 0xFFU);
}

/// CRC-32 bit by bit [PNG 1.2, annex D].
inline std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? 0xEDB88320U ^ (crc >> 1U) : crc >> 1U;
  }
  return crc ^ 0xFFFFFFFFU;
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
  std::string chunk;
  append_big_endian(chunk, static_cast<std::uint32_t>(data.size()));
  chunk += type + data;
  append_big_endian(chunk, crc32(type + data));
  return chunk;
}

/// A zlib stream of stored blocks [RFC 1950, 1951].
inline std::string zlib_stored(const std::string& data) {
  std::string out = "\x78\x01";
  constexpr std::size_t most = 65535;
  for (std::size_t at = 0; at == 0 || at < data.size(); at += most) {
    const std::string block = data.substr(at, most);
    const auto size = static_cast<unsigned>(block.size());
    out += at + most >= data.size() ? '\x01' : '\x00';
    for (const unsigned n : {size, ~size}) {
      out += static_cast<char>(n & 0xFFU);
      out += static_cast<char>((n >> 8U) & 0xFFU);
    }
    out += block;
  }
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const char c : data) {
    a = (a + static_cast<unsigned char>(c)) % 65521U;
    b = (b + a) % 65521U;
  }
  append_big_endian(out, (b << 16U) | a);
  return out;
}

inline const std::string png_signature = "\x89PNG\r\n\x1a\n";

struct PngSpec {
  int width = 1;
  int height = 1;
  int depth = 8;
  int color_type = 2;                  // 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGB and alpha
  bool interlaced = false;             // Adam7
  std::vector<unsigned> samples = {};  // as stored, channels interleaved, rows from the top
  std::string palette = {};            // PLTE
  std::string transparency = {};       // tRNS
  std::string extra = {};              // chunks before the pixels
  int stored_channels() const {
    constexpr int channels[] = {1, 0, 3, 1, 2, 0, 4};
    return channels[color_type];
  }
};

inline std::string png_header(const PngSpec& spec) {
  std::string data;
  append_big_endian(data, static_cast<std::uint32_t>(spec.width));
  append_big_endian(data, static_cast<std::uint32_t>(spec.height));
  data += static_cast<char>(spec.depth);
  data += static_cast<char>(spec.color_type);
  data += '\0';
  data += '\0';
  data += spec.interlaced ? '\x01' : '\0';
  return png_chunk("IHDR", data);
}

/// Every dx-th pixel from x0 of every dy-th row from y0, each row with filter type 0.
inline void append_pass(std::string& out, const PngSpec& spec, int x0, int y0, int dx, int dy) {
  if (x0 >= spec.width) return;
  for (int y = y0; y < spec.height; y += dy) {
    out += '\0';
    unsigned bits = 0;
    int held = 0;
    for (int x = x0; x < spec.width; x += dx) {
      for (int c = 0; c < spec.stored_channels(); ++c) {
        const int pixel = y * spec.width + x;
        const unsigned value = spec.samples[static_cast<std::size_t>(pixel * spec.stored_channels() + c)];
        bits = (bits << static_cast<unsigned>(spec.depth)) | value;
        held += spec.depth;
        while (held >= 8) out += static_cast<char>((bits >> static_cast<unsigned>(held -= 8)) & 0xFFU);
      }
    }
    if (held > 0) out += static_cast<char>((bits << static_cast<unsigned>(8 - held)) & 0xFFU);
  }
}

inline std::string png_rows(const PngSpec& spec) {
  std::string rows;
  if (!spec.interlaced) {
    append_pass(rows, spec, 0, 0, 1, 1);
    return rows;
  }
  constexpr int passes[7][4] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
  for (const auto& p : passes) append_pass(rows, spec, p[0], p[1], p[2], p[3]);
  return rows;
}

inline std::string make_png(const PngSpec& spec) {
  std::string png = png_signature + png_header(spec) + spec.extra;
  if (!spec.palette.empty()) png += png_chunk("PLTE", spec.palette);
  if (!spec.transparency.empty()) png += png_chunk("tRNS", spec.transparency);
  return png + png_chunk("IDAT", zlib_stored(png_rows(spec))) + png_chunk("IEND", "");
}

/// Samples that differ from each other, each of `depth` bits and at most `largest`.
inline std::vector<unsigned> noise_samples(std::size_t count, int depth, unsigned largest = 0xFFFFU) {
  std::vector<unsigned> samples(count);
  std::uint32_t state = 20240607U;
  for (unsigned& sample : samples) {
    state = state * 1664525U + 1013904223U;
    sample = std::min((state >> 8U) & ((1U << static_cast<unsigned>(depth)) - 1U), largest);
  }
  return samples;
}

}  // namespace lagomorph::tests
