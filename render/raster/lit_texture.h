#pragma once

#include "render/raster/gl_objects.h"
#include "render/raster/lit_pixels.h"

namespace lagomorph::render::raster {

/// LitPixels as the shaders read them: a layer each for the lights, the sky, and the sky mirrored.
class LitTexture {
public:
  /// For sampler `unit` (GL_TEXTURE0 and on).
  LitTexture(GLenum unit, int width, int height);

  /// Puts them where they belong, as far as they are within, and binds the texture.
  void take(const LitPixels&) const;

private:
  GLenum unit_;
  int width_, height_;
  Texture texture_;
};

}  // namespace lagomorph::render::raster
