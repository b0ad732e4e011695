#pragma once

#include <initializer_list>
#include <string>
#include <utility>

#include "render/raster/gl.h"

/// Owners of GL names. The context that they were made in must be current when they are made, used and
/// destroyed.
namespace lagomorph::render::raster {

template <void (*generate)(GLsizei, GLuint*), void (*destroy)(GLsizei, const GLuint*)>
class GlName {
public:
  GlName() { generate(1, &id_); }
  ~GlName() { destroy(1, &id_); }
  GlName(GlName&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  GLuint id() const { return id_; }

private:
  GLuint id_ = 0;
};

using Buffer = GlName<glGenBuffers, glDeleteBuffers>;
using VertexArray = GlName<glGenVertexArrays, glDeleteVertexArrays>;
using Texture = GlName<glGenTextures, glDeleteTextures>;
using Renderbuffer = GlName<glGenRenderbuffers, glDeleteRenderbuffers>;
using Query = GlName<glGenQueries, glDeleteQueries>;
using Framebuffer = GlName<glGenFramebuffers, glDeleteFramebuffers>;

/// A vertex and a fragment shader, linked. The parts of each are put one after the other, after the version
/// and, for a fragment shader, `#define FRAGMENT`.
class Program {
public:
  using Parts = std::initializer_list<const char*>;
  /// Throws DeviceError with the first line of the driver's log.
  Program(const std::string& name, Parts vertex, Parts fragment);
  ~Program() { glDeleteProgram(id_); }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use() const { glUseProgram(id_); }
  /// -1, which GL ignores, for a uniform that the shader does not use.
  GLint location(const char* uniform) const { return glGetUniformLocation(id_, uniform); }

private:
  GLuint id_ = 0;
};

/// An empty framebuffer object for textures to be attached to, bound.
void bind(const Framebuffer&, int width, int height);
/// Throws DeviceError when the bound framebuffer cannot be drawn to.
void check_framebuffer(const char* name);
/// Throws DeviceError for any error that GL has noted.
void check_gl(const char* doing);

}  // namespace lagomorph::render::raster
