#include "render/raster/still_picture.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/raster/pixel_ray.h"
#include "render/raster/shaders/shaders.h"

namespace lagomorph::render::raster {
namespace {

std::string still_definitions(const LightFeatures& features, int lights) {
  return features.definitions() + "#define LIGHTS " + std::to_string(lights) + "\n";
}

}  // namespace

StillPicture::StillPicture(const LightFeatures& features, int lights)
    : features_(features),
      lights_(lights),
      still_("still picture", {shaders::full_screen_vertex},
             {still_definitions(features, lights).c_str(), shaders::frame, shaders::brdf, shaders::sky,
              shaders::shade, shaders::ground_point, shaders::ground_color, shaders::still_fragment}),
      light_("ground's light", {shaders::full_screen_vertex},
             {still_definitions(features, lights).c_str(), shaders::frame, shaders::brdf, shaders::sky,
              shaders::shade, shaders::ground_point, shaders::ground_light_fragment}) {
  read_.lights = lights;
}

StillPicture::Sized::Sized(int w, int h, int count) : width(w), height(h) {
  glActiveTexture(GL_TEXTURE14);  // the maps are bound to their own
  glBindTexture(GL_TEXTURE_2D, picture.id());
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, w, h);
  glBindTexture(GL_TEXTURE_2D_ARRAY, parts.id());
  glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_RGBA16F, w, h, count);
  for (const GLenum kind : {GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY}) {
    glTexParameteri(kind, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(kind, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  }
  bind(target, w, h);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture.id(), 0);
  std::vector<GLenum> buffers = {GL_COLOR_ATTACHMENT0};
  for (int i = 0; i < count; ++i) {
    buffers.push_back(GL_COLOR_ATTACHMENT1 + static_cast<GLenum>(i));
    glFramebufferTextureLayer(GL_FRAMEBUFFER, buffers.back(), parts.id(), 0, i);
  }
  glDrawBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
  check_framebuffer("still picture");
}

const StillParts& StillPicture::draw(const FrameBlock& frame, int first_row, int last_row) {
  const View view = {frame.eye, frame.forward, frame.right, frame.up, frame.viewport, frame.sky_picture};
  if (!(seen_by_ == view)) {
    const int width = static_cast<int>(frame.viewport.x()), height = static_cast<int>(frame.viewport.y());
    if (!sized_ || sized_->width != width || sized_->height != height) {
      sized_.reset();
      sized_.emplace(width, height, parts());
      read_.width = width, read_.height = height;
      read_.picture.resize(3 * read_.pixels());
      read_.planes.resize((1 + 3 * static_cast<std::size_t>(parts())) * read_.pixels());
    }
    bind(sized_->target, width, height);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    still_.use();
    glBindVertexArray(no_attributes_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    read_picture();
    if (const bool below = ground_is_below(frame); light_of_ground_below_ != below) {
      read_light();
      light_of_ground_below_ = below;
    }
    first_row_ = last_row_ = 0;
    seen_by_ = view;
  }
  first_row = std::max(first_row, 0), last_row = std::min(last_row, read_.height);
  if (first_row >= last_row) return read_;
  if (first_row_ == last_row_) first_row_ = last_row_ = first_row;
  if (first_row < first_row_) read_rows(first_row, first_row_);
  if (last_row > last_row_) read_rows(last_row_, last_row);
  first_row_ = std::min(first_row_, first_row), last_row_ = std::max(last_row_, last_row);
  return read_;
}

void StillPicture::read_picture() {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, sized_->target.id());
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  values_.resize(4 * read_.pixels());
  glReadPixels(0, 0, read_.width, read_.height, GL_RGBA, GL_FLOAT, values_.data());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, read_.pixels(), 65536), [&](const auto& range) {
    for (std::size_t k = range.begin(); k != range.end(); ++k) {
      for (std::size_t c = 0; c < 3; ++c) read_.picture[3 * k + c] = values_[4 * k + c];
    }
  });
}

/// The light on the side of the ground that is seen, with nothing before it; it is the same everywhere.
void StillPicture::read_light() {
  const std::array<Texture, 2> light;
  const Framebuffer target;
  bind(target, 1, 1);
  glActiveTexture(GL_TEXTURE14);
  for (const GLenum k : {0U, 1U}) {
    glBindTexture(GL_TEXTURE_2D, light[k].id());
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, 1, 1);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + k, GL_TEXTURE_2D, light[k].id(), 0);
  }
  constexpr std::array<GLenum, 2> buffers = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glDrawBuffers(2, buffers.data());
  check_framebuffer("ground's light");
  light_.use();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  const std::array<Color*, 2> to = {&read_.open, &read_.from_below};
  for (const GLenum k : {0U, 1U}) {
    std::array<float, 4> value{};
    glReadBuffer(GL_COLOR_ATTACHMENT0 + k);
    glReadPixels(0, 0, 1, 1, GL_RGBA, GL_FLOAT, value.data());
    *to[k] = Color(value[0], value[1], value[2]);
  }
}

/// Of the planes.
void StillPicture::read_rows(int first, int last) {
  const auto width = static_cast<std::size_t>(read_.width);
  const std::size_t offset = static_cast<std::size_t>(first) * width;
  const std::size_t count = static_cast<std::size_t>(last - first) * width;
  halves_.resize(4 * count);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, sized_->target.id());
  std::uint16_t* plane = read_.planes.data() + offset;
  for (int part = 0; part < parts(); ++part) {
    glReadBuffer(GL_COLOR_ATTACHMENT1 + static_cast<GLenum>(part));
    glReadPixels(0, first, read_.width, last - first, GL_RGBA, GL_HALF_FLOAT, halves_.data());
    const std::size_t channels = part == 0 ? 4 : 3;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 65536), [&](const auto& range) {
      for (std::size_t c = 0; c < channels; ++c) {
        std::uint16_t* to = plane + c * read_.pixels();
        for (std::size_t k = range.begin(); k != range.end(); ++k) to[k] = halves_[4 * k + c];
      }
    });
    plane += channels * read_.pixels();
  }
}

}  // namespace lagomorph::render::raster
