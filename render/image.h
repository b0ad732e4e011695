#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lagomorph::render {

/// One named channel of floats: `components` values a pixel, interleaved, rows from the top.
struct Channel {
  std::string
      name;  // "color" (3), "depth" (1) [m along the view axis, +inf where nothing is], "normal" (3), ...
  int components = 1;  // values a pixel
  std::vector<float> values;
  int width = 0;  // of the channel: the picture's, less where squares of pixels share their values
  int height = 0;
};

/// Linear float channels of one size, by name. Tone curve and sRGB are applied once, at the PNG.
class Image {
public:
  Image() = default;
  Image(int width, int height) : width_(width), height_(height) {}

  int width() const { return width_; }
  int height() const { return height_; }
  const std::vector<Channel>& channels() const { return channels_; }

  /// Adds a channel of zeros (or returns the one there is) and gives its values, width*height*components, or
  /// components for each square of cell x cell pixels, those at the right and lower border being smaller.
  std::vector<float>& add(std::string_view name, int components, int cell = 1);
  /// The channel of that name; nullptr when there is none.
  const Channel* find(std::string_view name) const;

private:
  int width_ = 0;
  int height_ = 0;
  std::vector<Channel> channels_;
};

}  // namespace lagomorph::render
