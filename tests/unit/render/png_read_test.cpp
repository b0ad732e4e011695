#include "render/png_read.h"

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "render/png.h"
#include "tests/support/png_maker.h"

namespace lagomorph::render {
namespace png_read_test {

using tests::make_png;
using tests::noise_samples;
using tests::PngSpec;

std::vector<unsigned> samples_of(const Pixels& pixels) {
  return std::visit([](const auto& s) { return std::vector<unsigned>(s.begin(), s.end()); }, pixels.samples);
}

PngSpec noise(int width, int height, int depth, int color_type, bool interlaced) {
  PngSpec spec{.width = width, .height = height, .depth = depth, .color_type = color_type};
  spec.interlaced = interlaced;
  spec.samples = noise_samples(static_cast<std::size_t>(width * height * spec.stored_channels()), depth);
  return spec;
}

/// What the samples of a file without transparency are as RGB or RGBA.
std::vector<unsigned> expanded(const PngSpec& spec) {
  const auto stored = static_cast<std::size_t>(spec.stored_channels());
  const unsigned scale = spec.depth < 8 ? 255U / ((1U << static_cast<unsigned>(spec.depth)) - 1U) : 1U;
  std::vector<unsigned> out;
  for (std::size_t i = 0; i < spec.samples.size(); i += stored) {
    const bool grey = stored < 3;
    for (std::size_t c = 0; c < 3; ++c) out.push_back(scale * spec.samples[i + (grey ? 0 : c)]);
    if (stored == 2 || stored == 4) out.push_back(spec.samples[i + stored - 1]);
  }
  return out;
}

TEST(PngRead, EveryKindWithoutPalette) {
  struct Kind {
    int depth;
    int color_type;
    int channels;
  };
  for (const Kind kind : {Kind{1, 0, 1},
                          {2, 0, 1},
                          {4, 0, 1},
                          {8, 0, 1},
                          {16, 0, 1},
                          {8, 2, 3},
                          {16, 2, 3},
                          {8, 4, 2},
                          {16, 4, 2},
                          {8, 6, 4},
                          {16, 6, 4}}) {
    for (const bool interlaced : {false, true}) {
      for (const auto& [width, height] : {std::pair{1, 1}, {13, 11}, {3, 17}, {130, 2}}) {
        const PngSpec spec = noise(width, height, kind.depth, kind.color_type, interlaced);
        const Pixels pixels = read_png(make_png(spec), "a.png");
        SCOPED_TRACE(::testing::Message() << width << "x" << height << " type " << kind.color_type << " of "
                                          << kind.depth << (interlaced ? " interlaced" : ""));
        EXPECT_EQ(pixels.width, width);
        EXPECT_EQ(pixels.height, height);
        EXPECT_EQ(pixels.channels, kind.channels);
        EXPECT_EQ(pixels.alpha, kind.channels % 2 == 0);
        EXPECT_EQ(pixels.bit_depth(), kind.depth == 16 ? 16 : 8);
        EXPECT_EQ(samples_of(pixels), expanded(spec));
      }
    }
  }
}

TEST(PngRead, PalettesWithAndWithoutTransparency) {
  const std::string palette = "\x10\x20\x30\xFF\x80\x40\x01\x02\x03\xC8\xC9\xCA";
  for (const int depth : {2, 4, 8}) {
    for (const bool interlaced : {false, true}) {
      PngSpec spec{.width = 9, .height = 7, .depth = depth, .color_type = 3};
      spec.interlaced = interlaced;
      spec.palette = palette;
      spec.samples = noise_samples(63, depth, 3);
      for (const std::string& transparency : {std::string(), std::string("\x00\x7F", 2)}) {
        spec.transparency = transparency;
        std::vector<unsigned> expected;
        for (const unsigned index : spec.samples) {
          for (std::size_t c = 0; c < 3; ++c)
            expected.push_back(static_cast<unsigned char>(palette[3 * index + c]));
          if (transparency.empty()) continue;
          expected.push_back(index < 2 ? static_cast<unsigned char>(transparency[index]) : 255U);
        }
        const Pixels pixels = read_png(make_png(spec), "a.png");
        EXPECT_EQ(pixels.channels, transparency.empty() ? 3 : 4);
        EXPECT_EQ(pixels.alpha, !transparency.empty());
        EXPECT_EQ(samples_of(pixels), expected) << depth << " bits";
      }
    }
  }
}

TEST(PngRead, OneColourThatIsTransparent) {
  PngSpec spec{.width = 2, .height = 1, .depth = 8, .color_type = 2};
  spec.samples = {1, 2, 3, 4, 5, 6};
  spec.transparency = std::string("\0\x04\0\x05\0\x06", 6);
  const Pixels pixels = read_png(make_png(spec), "a.png");
  EXPECT_EQ(pixels.channels, 4);
  EXPECT_EQ(samples_of(pixels), (std::vector<unsigned>{1, 2, 3, 255, 4, 5, 6, 0}));

  PngSpec grey{.width = 2, .height = 1, .depth = 16, .color_type = 0};
  grey.samples = {515, 516};
  grey.transparency = "\x02\x03";
  const Pixels grey_pixels = read_png(make_png(grey), "a.png");
  EXPECT_EQ(grey_pixels.channels, 2);
  EXPECT_EQ(samples_of(grey_pixels), (std::vector<unsigned>{515, 515, 515, 0, 516, 516, 516, 65535}));
}

TEST(PngRead, GammaAndTextsChangeNothing) {
  PngSpec spec = noise(5, 4, 8, 2, false);
  const std::vector<unsigned> plain = samples_of(read_png(make_png(spec), "a.png"));
  spec.extra = tests::png_chunk("gAMA", std::string("\x00\x01\x86\xA0", 4)) +
               tests::png_chunk("sBIT", "\x04\x04\x04") +
               tests::png_chunk("tEXt", std::string("Title\0bunny", 11));
  EXPECT_EQ(samples_of(read_png(make_png(spec), "a.png")), plain);
}

TEST(PngRead, WhatTheProgramWrites) {
  Picture picture{40, 30, {}};
  for (const unsigned sample : noise_samples(3600, 8))
    picture.rgb.push_back(static_cast<std::uint8_t>(sample));
  const Pixels pixels = read_png(encode_png(picture, 6), "a.png");
  EXPECT_EQ(pixels.samples, to_pixels(picture).samples);
  EXPECT_EQ(pixels.channels, 3);
  EXPECT_FALSE(pixels.alpha);
}

std::string refusal(const std::string& bytes) {
  try {
    read_png(bytes, "bad.png");
  } catch (const PictureError& error) {
    return error.what();
  }
  return "read";
}

TEST(PngRead, RefusesEveryTruncation) {
  const std::string png = make_png(noise(7, 5, 8, 6, true));
  for (std::size_t size = 0; size < png.size(); ++size) {
    const std::string message = refusal(png.substr(0, size));
    EXPECT_NE(message.find(size == 0 ? "bad.png: is empty" : "bad.png: is truncated"), std::string::npos)
        << size << ": " << message;
  }
  EXPECT_EQ(refusal(png + "more"), "read");
}

TEST(PngRead, RefusesEveryFlippedBit) {
  const std::string png = make_png(noise(6, 5, 8, 2, false));
  for (std::size_t bit = 0; bit < 8 * png.size(); ++bit) {
    std::string damaged = png;
    damaged[bit / 8] = static_cast<char>(static_cast<unsigned char>(damaged[bit / 8]) ^ (1U << (bit % 8)));
    const std::string message = refusal(damaged);
    EXPECT_EQ(message.find("bad.png: "), 0U) << bit;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(PngRead, SaysWhatElseAFileIs) {
  EXPECT_EQ(refusal("\xFF\xD8\xFF\xE0 JFIF"),
            "bad.png: is no PNG: it starts with ff d8 ff e0, not with 89 50 4e 47");
  EXPECT_EQ(refusal("P6"), "bad.png: is no PNG: it starts with 50 36, not with 89 50 4e 47");
}

TEST(PngRead, RefusesHugeHeadersBeforeTakingMemory) {
  PngSpec spec = noise(4, 4, 8, 2, false);
  const std::string rest = make_png(spec).substr(8 + 25);
  const auto claims = [&](int width, int height) {
    PngSpec claim = spec;
    claim.width = width;
    claim.height = height;
    return refusal(tests::png_signature + tests::png_header(claim) + rest);
  };
  EXPECT_EQ(claims(100000, 100000),
            "bad.png: its header claims 100000x100000 pixels; 268435456 are the most that are read");
  EXPECT_EQ(claims(2147483647, 2147483647),
            "bad.png: its header claims 2147483647x2147483647 pixels; 268435456 are the most that are read");
  EXPECT_EQ(claims(16384, 16384),
            "bad.png: its header claims 16384x16384 pixels, more than its 63 bytes of data can hold");
  EXPECT_EQ(claims(0, 4), "bad.png: its header claims 0x4 pixels; one at least is needed");
  EXPECT_EQ(claims(4, 5).find("bad.png: is damaged: "), 0U) << claims(4, 5);
}

TEST(PngRead, RefusesWhatTheFormatForbids) {
  const PngSpec good = noise(4, 4, 8, 2, false);
  const std::string pixels = tests::png_chunk("IDAT", tests::zlib_stored(tests::png_rows(good)));
  const std::string end = tests::png_chunk("IEND", "");
  const auto with_header = [&](int depth, int color_type) {
    PngSpec spec = good;
    spec.depth = depth;
    spec.color_type = color_type;
    return refusal(tests::png_signature + tests::png_header(spec) + pixels + end);
  };
  EXPECT_EQ(with_header(4, 2), "bad.png: colour type 2 of 4 bits is none of a PNG's");
  EXPECT_EQ(with_header(8, 5), "bad.png: colour type 5 of 8 bits is none of a PNG's");
  EXPECT_EQ(with_header(3, 0), "bad.png: colour type 0 of 3 bits is none of a PNG's");
  EXPECT_EQ(with_header(8, 3), "bad.png: has colours by palette, and no palette (chunk PLTE)");
  const std::string header = tests::png_signature + tests::png_header(good);
  EXPECT_EQ(refusal(header + end), "bad.png: holds no pixels: chunk IDAT is missing");
  EXPECT_EQ(refusal(header + tests::png_header(good) + pixels + end), "bad.png: has two headers, IHDR");
  EXPECT_EQ(refusal(tests::png_signature + pixels + end), "bad.png: does not begin with its header, IHDR");
  EXPECT_EQ(refusal(header + tests::png_chunk("QRST", "x") + pixels + end).find("bad.png: is damaged: "), 0U);
  EXPECT_EQ(refusal(header + tests::png_chunk("IDAT", "nonsense") + end).find("bad.png: is damaged: "), 0U);
}

TEST(PngRead, HeaderAloneTellsTheKind) {
  PngSpec spec = noise(13, 11, 16, 4, true);
  const PngHeader header = read_png_header(make_png(spec), "a.png");
  EXPECT_EQ(header.width, 13);
  EXPECT_EQ(header.height, 11);
  EXPECT_EQ(header.bit_depth, 16);
  EXPECT_EQ(header.channels, 2);
  EXPECT_TRUE(header.alpha);
  EXPECT_TRUE(header.interlaced);
}

}  // namespace png_read_test
}  // namespace lagomorph::render
