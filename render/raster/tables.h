#pragma once

#include <vector>

#include "render/raster/gl_objects.h"

/// Tables that the shaders look up.
namespace lagomorph::render::raster {

/// How the bound texture is read; nothing of it repeats.
inline void sampling(GLenum target, GLenum minify, GLenum magnify) {
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(minify));
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, static_cast<GLint>(magnify));
  glTexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

/// Of two or four floats an entry.
template <class Entry>
void allocate_table(const Texture& texture, int width, int height, const std::vector<Entry>& entries) {
  static_assert(sizeof(Entry) == 8 || sizeof(Entry) == 16);
  constexpr bool pairs = sizeof(Entry) == 8;
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexStorage2D(GL_TEXTURE_2D, 1, pairs ? GL_RG32F : GL_RGBA32F, width, height);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, pairs ? GL_RG : GL_RGBA, GL_FLOAT, entries.data());
  sampling(GL_TEXTURE_2D, GL_LINEAR, GL_LINEAR);
}

}  // namespace lagomorph::render::raster
