#include "render/raster/lit_texture.h"

#include <algorithm>

namespace lagomorph::render::raster {

LitTexture::LitTexture(GLenum unit, int width, int height) : unit_(unit), width_(width), height_(height) {
  glActiveTexture(unit_);
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture_.id());
  glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_RGBA16, width, height, 3);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void LitTexture::take(const LitPixels& lit) const {
  glActiveTexture(unit_);
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture_.id());
  const PixelRectangle there = common_rectangle(lit.at, {0, 0, width_, height_});
  if (there.width == 0 || there.height == 0) return;
  glPixelStorei(GL_UNPACK_ROW_LENGTH, lit.at.width);
  GLint layer = 0;
  for (const std::vector<Parts>* parts : {&lit.lights, &lit.diffuse, &lit.mirrored}) {
    if (!parts->empty()) {
      glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, there.x, there.y, layer, there.width, there.height, 1, GL_RGBA,
                      GL_UNSIGNED_SHORT, parts->data());
    }
    ++layer;
  }
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

}  // namespace lagomorph::render::raster
