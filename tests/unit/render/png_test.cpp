#include "render/png.h"

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include "render/error.h"

namespace lagomorph::render {
namespace png_test {

/// Gradients with a deterministic grain, so that no filter predicts it all.
Picture grainy(int width, int height) {
  Picture picture{width, height, {}};
  std::uint32_t state = 12345;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        state = state * 1664525U + 1013904223U;
        picture.rgb.push_back(
            static_cast<std::uint8_t>(static_cast<std::uint32_t>(3 * x + 5 * y + 40 * c) + (state >> 29U)));
      }
    }
  }
  return picture;
}

std::vector<std::uint8_t> decode(const std::string& png, int width, int height) {
  int w = 0;
  int h = 0;
  int components = 0;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(png.data()), static_cast<int>(png.size()), &w,
                            &h, &components, 0),
      stbi_image_free);
  if (!pixels || w != width || h != height || components != 3) return {};
  return {pixels.get(), pixels.get() + 3 * w * h};
}

TEST(Png, AnotherDecoderReadsTheSamePixelsAtEveryLevel) {
  for (const auto& [width, height] : {std::pair{67, 45}, {1, 1}, {1, 9}, {300, 2}}) {
    const Picture picture = grainy(width, height);
    for (int level = 0; level <= 12; ++level) {
      EXPECT_EQ(decode(encode_png(picture, level), width, height), picture.rgb)
          << width << "x" << height << " level " << level;
    }
  }
}

TEST(Png, SaysThatItsColourIsSrgbBeforeThePixels) {
  const std::string png = encode_png(grainy(4, 4), 1);
  const std::size_t srgb = png.find("sRGB");
  ASSERT_NE(srgb, std::string::npos);
  EXPECT_LT(srgb, png.find("IDAT"));
  // CRC-32 of the chunk's type and data, bit by bit [PNG 1.2, annex D].
  std::uint32_t crc = 0xFFFFFFFFU;
  for (std::size_t i = srgb; i < srgb + 5; ++i) {
    crc ^= static_cast<std::uint8_t>(png[i]);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) ? 0xEDB88320U ^ (crc >> 1U) : crc >> 1U;
  }
  crc ^= 0xFFFFFFFFU;
  std::uint32_t stored = 0;
  for (std::size_t i = srgb + 5; i < srgb + 9; ++i)
    stored = (stored << 8U) | static_cast<std::uint8_t>(png[i]);
  EXPECT_EQ(stored, crc);
}

TEST(Png, SameBytesFromEveryThreadAndEachWithItsLevel) {
  const Picture picture = grainy(200, 100);
  std::vector<std::string> expected;
  for (int level = 0; level <= 8; ++level) expected.push_back(encode_png(picture, level));
  EXPECT_LT(expected[6].size(), expected[0].size());
  std::vector<int> wrong(4, 0);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 18; ++i) {
        const int level = (i + 2 * t) % 9;
        if (encode_png(picture, level) != expected[static_cast<std::size_t>(level)])
          ++wrong[static_cast<std::size_t>(t)];
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

TEST(Png, RefusesWhatIsNoPicture) {
  Picture picture = grainy(4, 4);
  EXPECT_THROW(encode_png(picture, 13), SettingsError);
  EXPECT_THROW(encode_png(picture, -1), SettingsError);
  picture.rgb.pop_back();
  EXPECT_THROW(encode_png(picture, 1), SettingsError);
  EXPECT_THROW(encode_png({}, 1), SettingsError);
}

}  // namespace png_test
}  // namespace lagomorph::render
