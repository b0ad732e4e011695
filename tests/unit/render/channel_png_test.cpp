#include "render/channel_png.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "render/channels.h"
#include "render/color.h"
#include "render/error.h"
#include "render/png_read.h"

namespace lagomorph::render {
namespace channel_png_test {

Channel channel(const char* name, std::vector<float> values, int width) {
  const int components = channel_kind(name).components;
  const int height = static_cast<int>(values.size()) / components / width;
  return {name, components, std::move(values), width, height};
}

/// 16-bit samples, three a pixel; of grey ones all the same.
std::vector<int> samples(const Channel& c) {
  const Pixels pixels = read_png(encode_channel_png(c, 1), "test");
  EXPECT_EQ(pixels.width, c.width);
  EXPECT_EQ(pixels.height, c.height);
  EXPECT_EQ(pixels.channels, c.components);
  const auto& all = std::get<std::vector<std::uint16_t>>(pixels.samples);
  return {all.begin(), all.end()};
}

TEST(ChannelPng, NormalsAreHalvedAndMovedByHalf) {
  const std::vector<int> s =
      samples(channel(normal_channel, {1, -1, 0, 0.6F, -0.8F, 0.5F, 0, 0, 0, 0.25F, 0.125F, -0.25F}, 2));
  const std::vector<int> expected = {65535, 0,     32768, 52428, 6554,  49151,
                                     32768, 32768, 32768, 40959, 36863, 24576};
  ASSERT_EQ(s.size(), expected.size());
  for (std::size_t i = 0; i < s.size(); ++i) EXPECT_NEAR(s[i], expected[i], 1) << i;
  EXPECT_EQ(s[0], 65535);
  EXPECT_EQ(s[2], 32768);
}

TEST(ChannelPng, AlbedosAreSrgbAndAlphaIsLinear) {
  const std::vector<int> color = samples(channel(albedo_channel, {0, 0.18F, 1, 0.5F, 2, -1}, 1));
  const std::vector<int> wanted = {0, 30235, 65535, 48192, 65535, 0};  // IEC 61966-2-1, 0.18: 0.46136
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(color[i], wanted[i], 4) << i;
  const std::vector<int> alpha = samples(channel(alpha_channel, {0, 0.25F, 1}, 3));
  EXPECT_EQ(alpha[0], 0);
  EXPECT_EQ(alpha[3], 16384);
  EXPECT_EQ(alpha[6], 65535);
  const std::string srgb = encode_channel_png(channel(albedo_channel, {0, 0, 0}, 1), 1),
                    data = encode_channel_png(channel(normal_channel, {0, 0, 0}, 1), 1);
  EXPECT_NE(srgb.find("sRGB"), std::string::npos);
  EXPECT_EQ(data.find("sRGB"), std::string::npos);
}

TEST(ChannelPng, IdsAreOneMore) {
  const std::vector<int> ids = samples(channel(body_id_channel, {-1, 0, 7, 300}, 2));
  EXPECT_EQ(ids[0], 0);
  EXPECT_EQ(ids[3], 1);
  EXPECT_EQ(ids[6], 8);
  EXPECT_EQ(ids[9], 301);
  EXPECT_EQ(samples(channel(triangle_id_channel, {65534}, 1))[0], 65535);
  EXPECT_EQ(samples(channel(sample_count_channel, {64}, 1))[0], 64);
}

TEST(ChannelPng, DepthsAreMillimetres) {
  const float infinity = std::numeric_limits<float>::infinity();
  for (const char* const name : {depth_channel, denoising_depth_channel}) {
    const std::vector<int> depths =
        samples(channel(name, {1.2344F, 0.0001F, 65.534F, 65.536F, 1e9F, infinity, std::nanf("")}, 1));
    const std::vector<int> wanted = {1234, 1, 65534, 65535, 65535, 0, 0};
    for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_EQ(depths[3 * i], wanted[i]) << name << i;
  }
}

TEST(ChannelPng, WhatDoesNotFitIsRefused) {
  try {
    encode_channel_png(channel(triangle_id_channel, {3, 65535}, 2), 1);
    FAIL();
  } catch (const SettingsError& e) {
    EXPECT_EQ(
        std::string(e.what()),
        "render.channels: 'triangle_id' has the number 65535, which does not fit into the 16 bits of a PNG; "
        "render.channel_format = \"npy\" or \"exr\" holds it");
  }
  for (const ChannelKind& kind : channel_kinds()) {
    const std::string name = kind.name;
    EXPECT_EQ(fits_png(name), name == "depth" || name == "denoising_depth" || name == "normal" ||
                                  name == "albedo" || name == "alpha" || name == "body_id" ||
                                  name == "triangle_id" || name == "sample_count" ||
                                  name == "denoising_albedo" || name == "denoising_normal")
        << name;
  }
  EXPECT_THROW(encode_channel_png(channel(position_channel, {1, 2, 3}, 1), 1), SettingsError);
}

/// A picture of noise, so that rows and filters matter, comes back.
TEST(ChannelPng, EveryPixelComesBack) {
  std::vector<float> values;
  std::uint32_t state = 7;
  for (int i = 0; i < 3 * 37 * 23; ++i) {
    state = state * 1664525U + 1013904223U;
    values.push_back(static_cast<float>(state >> 8U) / static_cast<float>(1U << 23U) - 1.0F);
  }
  const std::vector<int> s = samples(channel(normal_channel, values, 37));
  ASSERT_EQ(s.size(), values.size());
  for (std::size_t i = 0; i < s.size(); ++i)
    ASSERT_NEAR(s[i] / 65535.0 * 2.0 - 1.0, static_cast<double>(values[i]), 1.01 / 65535.0) << i;
}

}  // namespace channel_png_test
}  // namespace lagomorph::render
