#pragma once

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

  /// Binds the colour target with its depth buffer, cleared.
  void begin_color() const;
  /// Mean of the samples, into the channel: 3 floats a pixel, rows from the top.
  void read_color(Image&);
  /// Binds the depth channel's target, cleared to infinity.
  void begin_depth();
  void read_depth(Image&);

private:
  void allocate_depth_channel();

  int width_, height_, samples_;
  Program resolve_;
  VertexArray no_attributes_;
  Texture samples_color_, color_, depth_channel_;
  Renderbuffer samples_depth_, depth_;
  Framebuffer draw_target_, color_target_, depth_target_;
  bool has_depth_channel_ = false;
  std::vector<float> pixels_;
};

}  // namespace lagomorph::render::raster
