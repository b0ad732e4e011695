#include "render/exr.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfFramesPerSecond.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include "render/channels.h"
#include "render/error.h"

namespace lagomorph::render {
namespace {

/// A file in memory.
class Bytes final : public Imf::OStream {
public:
  Bytes() : OStream("OpenEXR") {}

  void write(const char data[], int count) override {
    const auto n = static_cast<std::size_t>(count);
    if (at_ + n > bytes_.size()) bytes_.resize(at_ + n);
    std::memcpy(bytes_.data() + at_, data, n);
    at_ += n;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t at) override { at_ = at; }

  std::string take() { return std::move(bytes_); }

private:
  std::string bytes_;
  std::size_t at_ = 0;
};

/// One of a file's channels: a value a pixel, `stride` floats from one to the next.
struct ExrPlane {
  std::string name;
  const float* values;
  std::size_t stride;
};

void add_planes(const Channel& channel, std::vector<ExrPlane>& planes) {
  const ChannelKind& kind = channel_kind(channel.name);
  for (std::size_t i = 0; i < static_cast<std::size_t>(kind.components); ++i) {
    std::string name(1, kind.parts[i]);
    if (kind.is_layer) name.insert(0, channel.name + ".");
    planes.push_back({std::move(name), channel.values.data() + i, static_cast<std::size_t>(kind.components)});
  }
}

std::string encode(int width, int height, const std::vector<ExrPlane>& planes, const ExrHeader& told) {
  const PartOfPicture at = told.part.value_or(PartOfPicture{0, 0, width, height});
  const Imath::Box2i display({0, 0}, {at.width - 1, at.height - 1});
  const Imath::Box2i data({at.x, at.y}, {at.x + width - 1, at.y + height - 1});
  Imf::Header header(display, data);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::addChromaticities(header, {});                                            // Rec. 709
  if (told.fps) Imf::addFramesPerSecond(header, Imf::guessExactFps(*told.fps));  // 23.976 is 24000/1001
  Imf::FrameBuffer pixels;
  for (const ExrPlane& plane : planes) {
    header.channels().insert(plane.name, Imf::Channel(Imf::FLOAT));
    // The library writes from what it takes as not const.
    float* values = const_cast<float*>(plane.values);
    const std::size_t step = plane.stride * sizeof(float);
    pixels.insert(plane.name,
                  Imf::Slice::Make(Imf::FLOAT, values, data, step, step * static_cast<std::size_t>(width)));
  }
  Bytes bytes;
  {
    Imf::OutputFile file(bytes, header, 0);  // no threads of its own
    file.setFrameBuffer(pixels);
    file.writePixels(height);
  }  // completes the table of lines
  return bytes.take();
}

const Channel& wanted(const Image& image, const std::string& name) {
  if (const Channel* channel = image.find(name)) return *channel;
  throw SettingsError("the image has no channel '" + name + "' to write");
}

}  // namespace

std::string encode_exr(const Channel& channel, const ExrHeader& header) {
  std::vector<ExrPlane> planes;
  add_planes(channel, planes);
  return encode(channel.width, channel.height, planes, header);
}

std::string encode_multilayer_exr(const Image& image, std::span<const std::string> channels, bool transparent,
                                  const ExrHeader& header) {
  std::vector<ExrPlane> planes;
  add_planes(wanted(image, color_channel), planes);
  std::vector<float> opaque;
  if (!transparent) opaque.assign(wanted(image, color_channel).values.size() / 3, 1.0F);
  planes.push_back({"A", transparent ? wanted(image, alpha_channel).values.data() : opaque.data(), 1});
  for (const std::string& name : channels) {
    if (name != color_channel && channel_kind(name).cell == 1) add_planes(wanted(image, name), planes);
  }
  return encode(image.width(), image.height(), planes, header);
}

}  // namespace lagomorph::render
