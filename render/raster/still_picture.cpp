#include "render/raster/still_picture.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

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
      taken_("ground under meshes", {shaders::frame, shaders::tiles_vertex},
             {still_definitions(features, lights).c_str(), shaders::frame, shaders::brdf, shaders::sky,
              shaders::shade, shaders::ground_point, shaders::taken_fragment}) {
  glBindVertexArray(tiles_.id());
  glVertexAttribFormat(0, 4, GL_FLOAT, GL_FALSE, 0);
  glVertexAttribIFormat(1, 1, GL_UNSIGNED_INT, offsetof(TileRun, lights_hidden));
  for (const GLuint attribute : {0U, 1U}) {
    glVertexAttribBinding(attribute, 0);
    glEnableVertexAttribArray(attribute);
  }
  glBindVertexBuffer(0, tile_buffer_.id(), 0, sizeof(TileRun));
  glVertexBindingDivisor(0, 1);  // a run an instance
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

void StillPicture::draw(const FrameBlock& frame) {
  const View view = {frame.eye, frame.forward, frame.right, frame.up, frame.viewport, frame.sky_picture};
  if (seen_by_ == view) return;
  const int width = static_cast<int>(frame.viewport.x()), height = static_cast<int>(frame.viewport.y());
  if (!sized_ || sized_->width != width || sized_->height != height) {
    sized_.reset();
    sized_.emplace(width, height, parts());
  }
  bind(sized_->target, width, height);
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  still_.use();
  glBindVertexArray(no_attributes_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  seen_by_ = view;
}

void StillPicture::draw_touched(std::span<const TileRun> runs) const {
  if (runs.empty()) return;
  glActiveTexture(GL_TEXTURE14);
  glBindTexture(GL_TEXTURE_2D, sized_->picture.id());
  glActiveTexture(GL_TEXTURE15);
  glBindTexture(GL_TEXTURE_2D_ARRAY, sized_->parts.id());
  glBindBuffer(GL_ARRAY_BUFFER, tile_buffer_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(runs.size_bytes()), runs.data(), GL_STREAM_DRAW);
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  taken_.use();
  glBindVertexArray(tiles_.id());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(runs.size()));
}

}  // namespace lagomorph::render::raster
