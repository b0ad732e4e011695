#pragma once

#include <vector>

#include "render/image.h"
#include "render/raster/gl_objects.h"

namespace lagomorph::render::raster {

/// What a picture of one size is drawn to.
class Targets {
public:
  /// `samples` is 1 or 4. Throws DeviceError when they cannot be had.
  Targets(int width, int height, int samples);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Binds the samples that say what is seen, with a depth buffer.
  void bind_seen() const { bind(seen_target_, width_, height_); }
  /// Binds those samples as a texture of this unit.
  void bind_seen_texture(GLenum unit) const;
  /// Binds the picture, linear colour, with another depth buffer.
  void bind_color() const { bind(color_target_, width_, height_); }
  /// Binds a channel of one value a pixel, with the picture's depth buffer.
  void bind_depth();

  /// The picture into the channel "color", rows from the top.
  void read_color(Image&);
  /// The channel of one value a pixel, likewise.
  void read_values(std::vector<float>&);

private:
  int width_, height_, samples_;
  Texture seen_, color_, depth_channel_;
  Renderbuffer seen_depth_, depth_;
  Framebuffer seen_target_, color_target_, depth_target_;
  bool has_depth_channel_ = false;
  std::vector<float> pixels_;
};

}  // namespace lagomorph::render::raster
