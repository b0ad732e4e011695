#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "render/image.h"
#include "render/raster/gl_objects.h"
#include "render/raster/lit_texture.h"
#include "render/raster/view_range.h"

namespace lagomorph::render::raster {

/// What a picture of one size is drawn to.
class Targets {
public:
  /// `samples` is 1 or 4; `colors`: with the vertices' colours of what is seen. Throws DeviceError when they
  /// cannot be had.
  Targets(int width, int height, int samples, bool colors);

  int width() const { return width_; }
  int height() const { return height_; }
  bool colors() const { return colors_.has_value(); }

  /// Binds the samples that say what is seen, with a depth buffer.
  void bind_seen() const { bind(seen_target_, width_, height_); }
  /// Says of all samples that nothing is seen.
  void clear_seen() const;
  /// Binds those samples, and their colours, as the textures that the shaders read.
  void bind_seen_textures() const;
  /// Binds the picture of what is seen, linear colour times its cover, with another depth buffer.
  void bind_color() const { bind(color_target_, width_, height_); }
  /// Binds the surfaces of the first layer, SurfaceTexel, with the picture's depth buffer.
  void bind_surface() const { bind(surface_target_, width_, height_); }
  /// Binds those as the texture that the shaders read.
  void bind_surface_texture() const;
  /// Those of a rectangle, which may reach beyond the picture; nothing is there.
  void read_surface(const PixelRectangle&, std::vector<SurfaceTexel>&);
  /// Makes what was found of lights and sky the texture that the shaders read.
  void take(const LitPixels& lit) const { lit_.take(lit); }
  /// Binds a channel of one value a pixel, with the picture's depth buffer.
  void bind_depth();

  /// Room for the surfaces that are not opaque, made when it is asked for.
  void need_peels();
  /// Binds one of two targets like that of what is seen, empty, with the depths of what is seen. Its textures
  /// are those that the shaders read of bind_peeled_textures(), the other's are those of the pass before.
  void begin_peel(int number) const;
  void bind_peeled_textures(int number) const;
  /// Binds what they send together, or makes it the texture that the shaders read.
  void bind_peeled_color() const;
  void bind_peeled_color_texture() const;

  /// What the functions that read have taken so far, without what was still to be drawn before them [s].
  double seconds_reading() const { return seconds_reading_; }
  /// Reads a rectangle of that picture.
  void read_color(const PixelRectangle&);
  /// What was read over a linear colour, interleaved, rows from the top.
  void put_over(std::span<float> color) const;
  /// The channel of one value a pixel, likewise.
  void read_values(std::vector<float>&);

private:
  GLenum sampled() const { return samples_ > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D; }
  void read(const PixelRectangle&, GLenum format, GLenum type, void* to);
  void attach_samples(const Texture&, GLenum format, GLenum attachment) const;
  void attach_seen(const Texture& seen, const Texture* colors, const Renderbuffer& depth) const;

  struct Peel {
    Texture seen;
    std::optional<Texture> colors;
    Framebuffer target;
  };
  struct Peels {
    std::array<Peel, 2> of;
    Renderbuffer depth;
    Texture color;
    Framebuffer color_target;
  };

  int width_, height_, samples_;
  Texture seen_, color_, surface_, depth_channel_;
  LitTexture lit_;
  std::optional<Texture> colors_;
  Renderbuffer seen_depth_, depth_;
  Framebuffer seen_target_, color_target_, surface_target_, depth_target_;
  std::optional<Peels> peels_;
  bool has_depth_channel_ = false;
  double seconds_reading_ = 0.0;
  std::vector<float> pixels_;  // that were read
  PixelRectangle color_at_;    // of them, where they are colours
};

}  // namespace lagomorph::render::raster
