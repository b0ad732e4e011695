#include "render/raster/targets.h"

#include <algorithm>
#include <array>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/raster/shaders/shaders.h"

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

Targets::Targets(int width, int height, int samples)
    : width_(width),
      height_(height),
      samples_(samples),
      resolve_("resolve", {shaders::full_screen_vertex}, {shaders::resolve_fragment}) {
  glBindTexture(GL_TEXTURE_2D, color_.id());
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, width, height);
  bind(color_target_, width, height);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
  if (samples_ > 1) {
    check_framebuffer("picture");
    // Sixteen bits hold the samples to 0.05 %; their mean is made in 32.
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, samples_color_.id());
    glTexStorage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples, GL_RGBA16F, width, height, GL_TRUE);
    bind(draw_target_, width, height);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE,
                           samples_color_.id(), 0);
  }
  glBindRenderbuffer(GL_RENDERBUFFER, samples_depth_.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, GL_DEPTH_COMPONENT32F, width,
                                   height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, samples_depth_.id());
  check_framebuffer("samples");
}

void Targets::begin_color() const {
  bind(samples_ > 1 ? draw_target_ : color_target_, width_, height_);
  glClear(GL_DEPTH_BUFFER_BIT);  // every pixel's colour is drawn
}

void Targets::read_color(Image& image) {
  if (samples_ > 1) {
    bind(color_target_, width_, height_);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    resolve_.use();
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, samples_color_.id());
    glBindVertexArray(no_attributes_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  glBindFramebuffer(GL_READ_FRAMEBUFFER, color_target_.id());
  pixels_.resize(4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, pixels_.data());
  copy_rows(pixels_, 4, 3, width_, height_, image.add("color", 3));
}

void Targets::allocate_depth_channel() {
  glBindTexture(GL_TEXTURE_2D, depth_channel_.id());
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_R32F, width_, height_);
  bind(depth_target_, width_, height_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, depth_channel_.id(), 0);
  glBindRenderbuffer(GL_RENDERBUFFER, depth_.id());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width_, height_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  check_framebuffer("depth channel");
  has_depth_channel_ = true;
}

void Targets::begin_depth() {
  if (!has_depth_channel_) allocate_depth_channel();
  bind(depth_target_, width_, height_);
  const std::array<float, 4> nothing = {std::numeric_limits<float>::infinity(), 0.0F, 0.0F, 0.0F};
  glClearBufferfv(GL_COLOR, 0, nothing.data());
  glClear(GL_DEPTH_BUFFER_BIT);
}

void Targets::read_depth(Image& image) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, depth_target_.id());
  pixels_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  glReadPixels(0, 0, width_, height_, GL_RED, GL_FLOAT, pixels_.data());
  copy_rows(pixels_, 1, 1, width_, height_, image.add("depth", 1));
}

}  // namespace lagomorph::render::raster
