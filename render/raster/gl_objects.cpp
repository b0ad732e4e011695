#include "render/raster/gl_objects.h"

#include <array>
#include <vector>

#include "render/error.h"

namespace lagomorph::render::raster {
namespace {

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

GLuint compile(const std::string& name, GLenum kind, Program::Parts parts) {
  const GLuint shader = glCreateShader(kind);
  std::vector<const char*> sources = {"#version 450 core\n",
                                      kind == GL_FRAGMENT_SHADER ? "#define FRAGMENT\n" : ""};
  sources.insert(sources.end(), parts.begin(), parts.end());
  glShaderSource(shader, static_cast<GLsizei>(sources.size()), sources.data(), nullptr);
  glCompileShader(shader);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  std::array<char, 4096> log{};
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  glDeleteShader(shader);
  throw DeviceError("OpenGL does not compile the " +
                    std::string(kind == GL_VERTEX_SHADER ? "vertex" : "fragment") + " shader '" + name +
                    "': " + first_line(log.data()));
}

std::string framebuffer_status(GLenum status) {
  switch (status) {
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
      return "incomplete attachment";
    case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE:
      return "incomplete multisampling";
    case GL_FRAMEBUFFER_UNSUPPORTED:
      return "unsupported formats";
    default:
      return "status " + std::to_string(status);
  }
}

}  // namespace

Program::Program(const std::string& name, Parts vertex, Parts fragment) {
  const GLuint vs = compile(name, GL_VERTEX_SHADER, vertex);
  GLuint fs = 0;
  try {
    fs = compile(name, GL_FRAGMENT_SHADER, fragment);
  } catch (...) {
    glDeleteShader(vs);
    throw;
  }
  id_ = glCreateProgram();
  for (const GLuint shader : {vs, fs}) {
    glAttachShader(id_, shader);
    glDeleteShader(shader);  // with the program
  }
  glLinkProgram(id_);
  GLint linked = GL_FALSE;
  glGetProgramiv(id_, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return;
  std::array<char, 4096> log{};
  glGetProgramInfoLog(id_, static_cast<GLsizei>(log.size()), nullptr, log.data());
  glDeleteProgram(id_);
  throw DeviceError("OpenGL does not link the shader '" + name + "': " + first_line(log.data()));
}

void bind(const Framebuffer& framebuffer, int width, int height) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  glViewport(0, 0, width, height);
}

void check_framebuffer(const char* name) {
  check_gl(name);
  const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status == GL_FRAMEBUFFER_COMPLETE) return;
  throw DeviceError("OpenGL cannot draw to the framebuffer '" + std::string(name) +
                    "': " + framebuffer_status(status));
}

void check_gl(const char* doing) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  while (glGetError() != GL_NO_ERROR) {
  }
  throw DeviceError("OpenGL " +
                    (error == GL_OUT_OF_MEMORY ? std::string("is out of memory")
                                               : "reports error " + std::to_string(error)) +
                    " (" + doing + ")");
}

}  // namespace lagomorph::render::raster
