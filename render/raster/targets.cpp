#include "render/raster/targets.h"

#include <algorithm>
#include <array>
#include <chrono>
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

/// What a target of seen samples has, and their colours where they are wanted.
void Targets::attach_seen(const Texture& seen, const Texture* colors, const Renderbuffer& depth) const {
  attach_samples(seen, GL_RGBA32UI, GL_COLOR_ATTACHMENT0);
  if (colors != nullptr) {
    attach_samples(*colors, GL_RGBA16F, GL_COLOR_ATTACHMENT1);
    constexpr std::array<GLenum, 2> both = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glDrawBuffers(2, both.data());
  }
  glBindRenderbuffer(GL_RENDERBUFFER, depth.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples_ > 1 ? samples_ : 0, GL_DEPTH_COMPONENT32F,
                                   width_, height_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth.id());
  check_framebuffer("samples");
}

Targets::Targets(int width, int height, int samples, bool colors)
    : width_(width), height_(height), samples_(samples), lit_(GL_TEXTURE0, width, height) {
  bind_seen();
  if (colors) colors_.emplace();
  attach_seen(seen_, colors ? &*colors_ : nullptr, seen_depth_);

  bind_color();
  glBindTexture(GL_TEXTURE_2D, color_.id());
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, width, height);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
  glBindRenderbuffer(GL_RENDERBUFFER, depth_.id());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width_, height_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  check_framebuffer("picture");

  bind_surface();
  glBindTexture(GL_TEXTURE_2D, surface_.id());
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32UI, width, height);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, surface_.id(), 0);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  check_framebuffer("surfaces");
}

void Targets::bind_surface_texture() const {
  glActiveTexture(GL_TEXTURE15);
  glBindTexture(GL_TEXTURE_2D, surface_.id());
}

/// Of the framebuffer that is bound to be read.
void Targets::read(const PixelRectangle& r, GLenum format, GLenum type, void* to) {
  glFinish();
  const auto start = std::chrono::steady_clock::now();
  glReadPixels(r.x, r.y, r.width, r.height, format, type, to);
  seconds_reading_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void Targets::read_surface(const PixelRectangle& r, std::vector<SurfaceTexel>& texels) {
  texels.assign(static_cast<std::size_t>(r.width) * static_cast<std::size_t>(r.height), {});
  const PixelRectangle there = common_rectangle(r, {0, 0, width_, height_});
  glBindFramebuffer(GL_READ_FRAMEBUFFER, surface_target_.id());
  glPixelStorei(GL_PACK_ROW_LENGTH, r.width);
  read(there, GL_RGBA_INTEGER, GL_UNSIGNED_INT, texels.data());
  glPixelStorei(GL_PACK_ROW_LENGTH, 0);
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

void Targets::need_peels() {
  if (peels_) return;
  peels_.emplace();
  for (Peel& peel : peels_->of) {
    if (colors_) peel.colors.emplace();
    bind(peel.target, width_, height_);
    attach_seen(peel.seen, peel.colors ? &*peel.colors : nullptr, peels_->depth);
  }
  bind(peels_->color_target, width_, height_);
  glBindTexture(GL_TEXTURE_2D, peels_->color.id());
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, width_, height_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, peels_->color.id(), 0);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  check_framebuffer("peeled surfaces");
}

void Targets::begin_peel(int number) const {
  const Framebuffer& target = peels_->of[static_cast<std::size_t>(number)].target;
  bind(target, width_, height_);
  clear_seen();
  glBindFramebuffer(GL_READ_FRAMEBUFFER, seen_target_.id());
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  bind(target, width_, height_);
  glActiveTexture(GL_TEXTURE13);
  glBindTexture(sampled(), peels_->of[static_cast<std::size_t>(1 - number)].seen.id());
}

void Targets::bind_peeled_textures(int number) const {
  const Peel& peel = peels_->of[static_cast<std::size_t>(number)];
  glActiveTexture(GL_TEXTURE6);
  glBindTexture(sampled(), peel.seen.id());
  if (!peel.colors) return;
  glActiveTexture(GL_TEXTURE12);
  glBindTexture(sampled(), peel.colors->id());
}

void Targets::bind_peeled_color() const { bind(peels_->color_target, width_, height_); }

void Targets::bind_peeled_color_texture() const {
  glActiveTexture(GL_TEXTURE13);
  glBindTexture(GL_TEXTURE_2D, peels_->color.id());
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

void Targets::read_color(const PixelRectangle& r) {
  color_at_ = r;
  if (r.width <= 0 || r.height <= 0) return;
  const auto across = static_cast<std::size_t>(r.width);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, color_target_.id());
  pixels_.resize(4 * across * static_cast<std::size_t>(r.height));
  read(r, GL_RGBA, GL_FLOAT, pixels_.data());
}

void Targets::put_over(std::span<float> color) const {
  const PixelRectangle& r = color_at_;
  if (r.width <= 0 || r.height <= 0) return;
  const auto across = static_cast<std::size_t>(r.width), width = static_cast<std::size_t>(width_);
  tbb::parallel_for(tbb::blocked_range<int>(0, r.height, 32), [&](const auto& rows) {
    for (int row = rows.begin(); row != rows.end(); ++row) {
      const float* in = pixels_.data() + 4 * across * static_cast<std::size_t>(row);
      float* out = color.data() + 3 * (width * static_cast<std::size_t>(height_ - 1 - r.y - row) +
                                       static_cast<std::size_t>(r.x));
      for (std::size_t x = 0; x < across; ++x, in += 4, out += 3) {
        for (std::size_t c = 0; c < 3; ++c) out[c] = in[c] + (1.0F - in[3]) * out[c];
      }
    }
  });
}

void Targets::read_values(std::vector<float>& values) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, depth_target_.id());
  pixels_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  read({0, 0, width_, height_}, GL_RED, GL_FLOAT, pixels_.data());
  copy_rows(pixels_, 1, 1, width_, height_, values);
}

}  // namespace lagomorph::render::raster
