#include "render/channel_png.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

#include <libdeflate.h>

#include "render/channels.h"
#include "render/color.h"
#include "render/error.h"

namespace lagomorph::render {
namespace {

constexpr float png_scale = most_png_number;

float part_of(float value) { return png_scale * std::clamp(value, 0.0F, 1.0F); }

/// Of a length in metres that is there, at least 1 and at most what there is room for; of +inf 0.
float millimetres(float metres) {
  return std::isinf(metres) ? 0.0F : std::clamp(1000.0F * metres, 1.0F, png_scale);
}

/// The value of a channel as a sample, not rounded; NaN becomes 0.
float sample_of(PngForm form, float value) {
  if (std::isnan(value)) return 0.0F;
  switch (form) {
    case PngForm::unit_vector:
      return part_of(0.5F + 0.5F * value);
    case PngForm::color:
      return png_scale * srgb_from_linear(value);
    case PngForm::part:
      return part_of(value);
    case PngForm::length:
      return millimetres(value);
    case PngForm::id:
      return value + 1.0F;
    case PngForm::count:
      return value;
    case PngForm::none:
      break;
  }
  return 0.0F;
}

void append_word(std::string& bytes, std::uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((word >> shift) & 0xFFU);
}

void append_chunk(std::string& png, const std::string& type, const std::string& data) {
  append_word(png, static_cast<std::uint32_t>(data.size()));
  const std::string body = type + data;
  png += body;
  append_word(png, libdeflate_crc32(0, body.data(), body.size()));
}

std::string deflated(const std::string& data, int level) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(level), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::string out(libdeflate_zlib_compress_bound(compressor.get(), data.size()), '\0');
  out.resize(libdeflate_zlib_compress(compressor.get(), data.data(), data.size(), out.data(), out.size()));
  if (out.empty()) throw std::bad_alloc();
  return out;
}

/// Rows of big-endian samples, each less that of the pixel to its left (filter 1) [PNG 1.2, 6.3].
std::string filtered_rows(const Channel& channel, PngForm form) {
  const std::size_t row = 2 * static_cast<std::size_t>(channel.width * channel.components);
  const std::size_t pixel = 2 * static_cast<std::size_t>(channel.components);
  std::string rows;
  rows.reserve((row + 1) * static_cast<std::size_t>(channel.height));
  std::vector<std::uint8_t> bytes(row);
  std::size_t at = 0;
  for (int y = 0; y < channel.height; ++y) {
    for (std::size_t i = 0; i < row; i += 2, ++at) {
      const float value = sample_of(form, channel.values[at]);
      if (value < 0.0F || value > png_scale) {
        throw SettingsError("render.channels: '" + channel.name + "' has the number " +
                            std::to_string(static_cast<long long>(channel.values[at])) +
                            ", which does not fit into the 16 bits of a PNG; render.channel_format = \"npy\" "
                            "or \"exr\" holds it");
      }
      const auto sample = static_cast<unsigned>(std::lround(value));
      bytes[i] = static_cast<std::uint8_t>(sample >> 8U);
      bytes[i + 1] = static_cast<std::uint8_t>(sample & 0xFFU);
    }
    rows += '\1';
    for (std::size_t i = 0; i < row; ++i)
      rows += static_cast<char>(static_cast<std::uint8_t>(bytes[i] - (i < pixel ? 0 : bytes[i - pixel])));
  }
  return rows;
}

}  // namespace

bool fits_png(std::string_view channel) { return channel_kind(channel).png != PngForm::none; }

std::string encode_channel_png(const Channel& channel, int compression) {
  const PngForm form = channel_kind(channel.name).png;
  if (form == PngForm::none) throw SettingsError("'" + channel.name + "' does not fit into a PNG");
  std::string header;
  append_word(header, static_cast<std::uint32_t>(channel.width));
  append_word(header, static_cast<std::uint32_t>(channel.height));
  const bool is_color = channel.components == 3;
  header += {'\x10', is_color ? '\2' : '\0', '\0', '\0', '\0'};  // 16 bits, RGB or grey
  std::string png = "\x89PNG\r\n\x1A\n";
  append_chunk(png, "IHDR", header);
  if (form == PngForm::color) append_chunk(png, "sRGB", std::string(1, '\0'));
  append_chunk(png, "IDAT", deflated(filtered_rows(channel, form), compression));
  append_chunk(png, "IEND", "");
  return png;
}

}  // namespace lagomorph::render
