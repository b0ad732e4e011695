#include "render/exr.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <gtest/gtest.h>

#include "render/channels.h"
#include "render/error.h"

namespace lagomorph::render {
namespace exr_test {

class Bytes final : public Imf::IStream {
public:
  explicit Bytes(const std::string& bytes) : IStream("memory"), bytes_(bytes) {}
  bool read(char to[], int count) override {
    const auto n = static_cast<std::size_t>(count);
    if (at_ + n > bytes_.size()) throw std::runtime_error("ends too soon");
    std::memcpy(to, bytes_.data() + at_, n);
    at_ += n;
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override { at_ = at; }

private:
  const std::string& bytes_;
  std::size_t at_ = 0;
};

using Planes = std::map<std::string, std::vector<float>>;

Planes read(const std::string& bytes, int width, int height,
            const std::optional<PartOfPicture>& part = std::nullopt) {
  Bytes stream(bytes);
  Imf::InputFile file(stream, 0);
  const Imf::Header& header = file.header();
  const PartOfPicture at = part.value_or(PartOfPicture{0, 0, width, height});
  const Imath::Box2i data({at.x, at.y}, {at.x + width - 1, at.y + height - 1});
  EXPECT_EQ(header.dataWindow(), data);
  EXPECT_EQ(header.displayWindow(), Imath::Box2i({0, 0}, {at.width - 1, at.height - 1}));
  EXPECT_EQ(header.compression(), Imf::ZIP_COMPRESSION);
  EXPECT_TRUE(Imf::hasChromaticities(header));
  Planes planes;
  Imf::FrameBuffer pixels;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    EXPECT_EQ(c.channel().type, Imf::FLOAT) << c.name();
    std::vector<float>& values = planes[c.name()];
    values.resize(static_cast<std::size_t>(width * height));
    pixels.insert(c.name(), Imf::Slice::Make(Imf::FLOAT, values.data(), data, sizeof(float),
                                             sizeof(float) * static_cast<std::size_t>(width)));
  }
  file.setFrameBuffer(pixels);
  file.readPixels(at.y, at.y + height - 1);
  return planes;
}

std::vector<std::string> names(const Planes& planes) {
  std::vector<std::string> all;
  for (const auto& [name, values] : planes) all.push_back(name);
  return all;
}

constexpr int width = 21, height = 37;

/// Every channel, with values that tell where they are.
Image image_of_all() {
  Image image(width, height);
  float value = 0.0F;
  for (const ChannelKind& kind : channel_kinds()) {
    for (float& v : image.add(kind.name, kind.components, kind.cell)) v = value += 0.25F;
  }
  return image;
}

/// Component `k` of a channel.
std::vector<float> component(const Image& image, const char* channel, std::size_t k) {
  const Channel& c = *image.find(channel);
  std::vector<float> values;
  for (std::size_t i = k; i < c.values.size(); i += static_cast<std::size_t>(c.components))
    values.push_back(c.values[i]);
  return values;
}

TEST(Exr, EachChannelHasItsNamesAndValues) {
  const Image image = image_of_all();
  const auto of = [&](const char* channel) { return read(encode_exr(*image.find(channel)), width, height); };
  EXPECT_EQ(names(of(color_channel)), (std::vector<std::string>{"B", "G", "R"}));
  EXPECT_EQ(names(of(depth_channel)), std::vector<std::string>{"Z"});
  EXPECT_EQ(names(of(motion_channel)), (std::vector<std::string>{"motion.X", "motion.Y"}));
  EXPECT_EQ(names(of(alpha_channel)), std::vector<std::string>{"alpha.A"});
  EXPECT_EQ(names(of(body_id_channel)), std::vector<std::string>{"body_id.X"});
  Planes normal = of(normal_channel);
  EXPECT_EQ(names(normal), (std::vector<std::string>{"normal.X", "normal.Y", "normal.Z"}));
  EXPECT_EQ(normal["normal.Y"], component(image, normal_channel, 1));
}

TEST(Exr, KeepsWhatIsNoNumberAndTheSmallest) {
  Image image(3, 1);
  image.add(depth_channel, 1) = {std::numeric_limits<float>::infinity(), std::nanf(""),
                                 std::numeric_limits<float>::denorm_min()};
  const std::vector<float> z = read(encode_exr(*image.find(depth_channel)), 3, 1)["Z"];
  EXPECT_TRUE(std::isinf(z[0]) && std::isnan(z[1]));
  EXPECT_EQ(z[2], std::numeric_limits<float>::denorm_min());
}

TEST(Exr, OneFileHoldsThePictureAndAllChannels) {
  const Image image = image_of_all();
  const std::vector<std::string> all = channel_names();
  Planes opaque = read(encode_multilayer_exr(image, all, false), width, height);
  for (const ChannelKind& kind : channel_kinds()) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(kind.components); ++k) {
      const std::string letter(1, kind.parts[k]);
      const std::string name = kind.is_layer ? kind.name + ("." + letter) : letter;
      if (kind.cell > 1) {
        EXPECT_FALSE(opaque.contains(name));  // of another size
      } else {
        EXPECT_EQ(opaque[name], component(image, kind.name, k)) << name;
      }
    }
  }
  EXPECT_EQ(opaque["A"], std::vector<float>(static_cast<std::size_t>(width * height), 1.0F));
  Planes transparent = read(encode_multilayer_exr(image, {}, true), width, height);
  EXPECT_EQ(names(transparent), (std::vector<std::string>{"A", "B", "G", "R"}));
  EXPECT_EQ(transparent["A"], component(image, alpha_channel, 0));
  EXPECT_EQ(transparent["G"], component(image, color_channel, 1));
}

TEST(Exr, APartStandsWhereItIsInThePicture) {
  const Image image = image_of_all();
  const PartOfPicture part{7, 90, 640, 360};
  EXPECT_EQ(read(encode_exr(*image.find(depth_channel), {.part = part}), width, height, part)["Z"],
            component(image, depth_channel, 0));
  Planes layers =
      read(encode_multilayer_exr(image, channel_names(), true, {.part = part}), width, height, part);
  EXPECT_EQ(layers["normal.Y"], component(image, normal_channel, 1));
  EXPECT_EQ(layers["A"], component(image, alpha_channel, 0));
}

/// The rational of a file's framesPerSecond; 0/1 of one without.
Imf::Rational fps_of(const std::string& bytes) {
  Bytes stream(bytes);
  const Imf::InputFile file(stream, 0);
  return Imf::hasFramesPerSecond(file.header()) ? Imf::framesPerSecond(file.header()) : Imf::Rational(0, 1);
}

TEST(Exr, TellsTheFramesASecond) {
  const Image image = image_of_all();
  const Channel& depth = *image.find(depth_channel);
  const auto expect_fps = [&](double fps, int n, unsigned d) {
    for (const std::string& bytes :
         {encode_exr(depth, {.fps = fps}), encode_multilayer_exr(image, {}, true, {.fps = fps})}) {
      const Imf::Rational told = fps_of(bytes);
      EXPECT_EQ(told.n, n) << fps;
      EXPECT_EQ(told.d, d) << fps;
    }
  };
  expect_fps(30.0, 30, 1);
  expect_fps(12.5, 25, 2);
  expect_fps(23.976, 24000, 1001);  // as film and video have it
  expect_fps(60000.0 / 1001.0, 60000, 1001);
  EXPECT_EQ(fps_of(encode_exr(depth)).n, 0) << "of no sequence";
}

TEST(Exr, TheSameValuesGiveTheSameBytes) {
  const Image image = image_of_all();
  EXPECT_EQ(encode_multilayer_exr(image, channel_names(), true),
            encode_multilayer_exr(image, channel_names(), true));
}

TEST(Exr, WhatTheImageHasNotIsTold) {
  Image image(2, 2);
  image.add(color_channel, 3);
  EXPECT_THROW(encode_multilayer_exr(image, std::vector<std::string>{depth_channel}, false), SettingsError);
  EXPECT_THROW(encode_multilayer_exr(image, {}, true), SettingsError);
  EXPECT_THROW(encode_multilayer_exr(Image(2, 2), {}, false), SettingsError);
}

}  // namespace exr_test
}  // namespace lagomorph::render
