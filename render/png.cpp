#include "render/png.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>

#include <libdeflate.h>

namespace {

// stb calls its compressor without a context of ours: the level goes beside it, one a thread.
thread_local int zlib_level = 1;

/// stb frees the result with free().
unsigned char* compress_zlib(const unsigned char* data, int size, int* out_size, int /*quality*/) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(zlib_level), libdeflate_free_compressor);
  if (!compressor) return nullptr;
  const std::size_t input = static_cast<std::size_t>(size);
  const std::size_t bound = libdeflate_zlib_compress_bound(compressor.get(), input);
  auto* out = static_cast<unsigned char*>(std::malloc(bound));
  if (!out) return nullptr;
  const std::size_t written = libdeflate_zlib_compress(compressor.get(), data, input, out, bound);
  if (written == 0) {
    std::free(out);
    return nullptr;
  }
  *out_size = static_cast<int>(written);
  return out;
}

}  // namespace

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#define STBIW_ZLIB_COMPRESS compress_zlib
#include <stb_image_write.h>

#include "render/error.h"
#include "render/pixels.h"

namespace lagomorph::render {
namespace {

constexpr int header_bytes = 33;  // signature and IHDR
/// Length 1, "sRGB", perceptual intent, CRC [PNG 1.2, 4.2.2.3]. stb does not write one.
constexpr char srgb_chunk[] = "\x00\x00\x00\x01sRGB\x00\xAE\xCE\x1C\xE9";

}  // namespace

std::string encode_png(const Picture& picture, int compression) {
  const std::size_t pixels = static_cast<std::size_t>(std::max(picture.width, 0)) *
                             static_cast<std::size_t>(std::max(picture.height, 0));
  if (pixels == 0 || picture.rgb.size() != 3 * pixels ||
      (!picture.alpha.empty() && picture.alpha.size() != pixels)) {
    throw SettingsError("a picture of " + std::to_string(picture.width) + "x" +
                        std::to_string(picture.height) + " with " + std::to_string(picture.rgb.size()) +
                        " bytes is no PNG; 3 a pixel are right");
  }
  if (compression < 0 || compression > 12) {
    throw SettingsError("render.png_compression = " + std::to_string(compression) + " must be in 0..12");
  }
  // Filter 1 (Sub) for every row: stb's own search costs more than the rest together and gains little.
  static const bool filter_is_set = (stbi_write_force_png_filter = 1, true);
  static_cast<void>(filter_is_set);
  zlib_level = compression;
  int size = 0;
  const int samples = picture.alpha.empty() ? 3 : 4;
  const Pixels rgba = picture.alpha.empty() ? Pixels{} : to_pixels(picture);
  const std::uint8_t* data_in =
      picture.alpha.empty() ? picture.rgb.data() : std::get<std::vector<std::uint8_t>>(rgba.samples).data();
  const std::unique_ptr<unsigned char, decltype(&std::free)> bytes(
      stbi_write_png_to_mem(data_in, samples * picture.width, picture.width, picture.height, samples, &size),
      std::free);
  if (!bytes) throw std::bad_alloc();
  const char* data = reinterpret_cast<const char*>(bytes.get());
  std::string png(data, header_bytes);
  png.append(srgb_chunk, sizeof srgb_chunk - 1);
  png.append(data + header_bytes, static_cast<std::size_t>(size - header_bytes));
  return png;
}

}  // namespace lagomorph::render
