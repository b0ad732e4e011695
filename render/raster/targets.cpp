#include "render/raster/targets.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace lagomorph::render::raster {
namespace {

/// The first `components` of every `stride` floats, with the rows turned upside down: OpenGL's begin below.
void copy_rows(const std::vector<float>& from, std::size_t stride, std::size_t components, int width,
               int height, std::vector<float>& to) {
  const auto w = static_cast<std::size_t>(width);
  tbb::parallel_for(tbb::blocked_range<int>(0, height, 64), [&](const auto& rows) {
    for (int row = rows.begin(); row != rows.end(); ++row) {
      const float* in = from.data() + stride * w * static_cast<std::size_t>(height - 1 - row);
      float* out = to.data() + components * w * static_cast<std::size_t>(row);
      for (std::size_t x = 0; x < w; ++x, in += stride) out = std::copy_n(in, components, out);
    }
  });
}

}  // namespace

/// A texture of the bound target, with a value a sample.
void Targets::attach_samples(const Texture& texture, GLenum format, GLenum attachment) const {
  glBindTexture(sampled(), texture.id());
  if (samples_ > 1) {
    glTexStorage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples_, format, width_, height_, GL_TRUE);
  } else {
    glTexStorage2D(GL_TEXTURE_2D, 1, format, width_, height_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  }
  glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, sampled(), texture.id(), 0);
}

Targets::Targets(int width, int height, int samples, bool colors)
    : width_(width), height_(height), samples_(samples) {
  bind_seen();
  attach_samples(seen_, GL_RGBA32UI, GL_COLOR_ATTACHMENT0);
  if (colors) {
    attach_samples(colors_.emplace(), GL_RGBA16F, GL_COLOR_ATTACHMENT1);
    constexpr std::array<GLenum, 2> both = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glDrawBuffers(2, both.data());
  }
  glBindRenderbuffer(GL_RENDERBUFFER, seen_depth_.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, GL_DEPTH_COMPONENT32F, width,
                                   height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, seen_depth_.id());
  check_framebuffer("samples");

  bind_color();
  glBindTexture(GL_TEXTURE_2D, color_.id());
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, width, height);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
  glBindRenderbuffer(GL_RENDERBUFFER, depth_.id());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width_, height_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  check_framebuffer("picture");
}

void Targets::clear_seen() const {
  constexpr std::array<GLuint, 4> nothing = {0, 0, 0, 0};
  constexpr std::array<GLfloat, 4> no_color = {};
  glClearBufferuiv(GL_COLOR, 0, nothing.data());
  if (colors_) glClearBufferfv(GL_COLOR, 1, no_color.data());
  glClear(GL_DEPTH_BUFFER_BIT);
}

void Targets::bind_seen_textures() const {
  glActiveTexture(GL_TEXTURE6);
  glBindTexture(sampled(), seen_.id());
  if (!colors_) return;
  glActiveTexture(GL_TEXTURE12);
  glBindTexture(sampled(), colors_->id());
}

void Targets::bind_depth() {
  bind(depth_target_, width_, height_);
  if (has_depth_channel_) return;
  glBindTexture(GL_TEXTURE_2D, depth_channel_.id());
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_R32F, width_, height_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, depth_channel_.id(), 0);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  check_framebuffer("depth channel");
  has_depth_channel_ = true;
}

void Targets::read_color(Image& image) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, color_target_.id());
  pixels_.resize(4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, pixels_.data());
  copy_rows(pixels_, 4, 3, width_, height_, image.add("color", 3));
}

void Targets::read_values(std::vector<float>& values) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, depth_target_.id());
  pixels_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  glReadPixels(0, 0, width_, height_, GL_RED, GL_FLOAT, pixels_.data());
  copy_rows(pixels_, 1, 1, width_, height_, values);
}

}  // namespace lagomorph::render::raster
