#include "render/raster/data_pass.h"

#include <array>
#include <cstddef>
#include <initializer_list>
#include <string_view>

#include "render/channels.h"
#include "render/raster/programs.h"
#include "render/raster/shaders/shaders.h"

namespace lagomorph::render::raster {
namespace {

constexpr std::array<GLenum, 3> attachments = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
                                               GL_COLOR_ATTACHMENT2};

/// Where a channel's values begin and how many of them each attachment has: from `first` of its RGBA to
/// `component` of the channel.
struct Part {
  std::size_t attachment;
  const char* channel;
  std::size_t first, component, count;
};
constexpr std::array<Part, 6> parts = {{
    {0, position_channel, 0, 0, 3},
    {0, triangle_id_channel, 3, 0, 1},
    {1, normal_channel, 0, 0, 3},
    {1, motion_channel, 3, 0, 1},
    {2, albedo_channel, 0, 0, 3},
    {2, motion_channel, 3, 1, 1},
}};

}  // namespace

DataPass::DataPass(int width, int height, bool colors, const LightFeatures& features)
    : width_(width),
      height_(height),
      colors_(colors),
      mesh_("mesh data", {"#define MOTION\n", color_definition(colors), shaders::frame, shaders::mesh_vertex},
            {color_definition(colors), shaders::frame, shaders::data_outputs, shaders::data_fragment}),
      ground_("ground data", {shaders::frame, shaders::ground_vertex},
              {features.definitions().c_str(), shaders::frame, shaders::ground_point, shaders::ground_color,
               shaders::data_outputs, shaders::ground_data_fragment}) {
  bind(target_, width, height);
  const std::array<const Texture*, 3> textures = {&position_and_triangle_, &normal_and_motion_x_,
                                                  &albedo_and_motion_y_};
  for (std::size_t i = 0; i < textures.size(); ++i) {
    glBindTexture(GL_TEXTURE_2D, textures[i]->id());
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, width, height);
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachments[i], GL_TEXTURE_2D, textures[i]->id(), 0);
  }
  glDrawBuffers(static_cast<GLsizei>(attachments.size()), attachments.data());
  glBindRenderbuffer(GL_RENDERBUFFER, depth_.id());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  check_framebuffer("data channels");
}

void DataPass::begin(const Mat4& clip_before) const {
  bind(target_, width_, height_);
  glEnable(GL_DEPTH_TEST);
  constexpr std::array<float, 4> no_triangle = {0.0F, 0.0F, 0.0F, -1.0F};
  constexpr std::array<float, 4> nothing = {};
  glClearBufferfv(GL_COLOR, 0, no_triangle.data());
  glClearBufferfv(GL_COLOR, 1, nothing.data());
  glClearBufferfv(GL_COLOR, 2, nothing.data());
  glClear(GL_DEPTH_BUFFER_BIT);
  for (const Program* program : {&mesh_, &ground_}) {
    program->use();
    glUniformMatrix4fv(program->location("clip_before"), 1, GL_FALSE, clip_before.data());
  }
}

void DataPass::read(Image& image) {
  const auto width = static_cast<std::size_t>(width_), height = static_cast<std::size_t>(height_);
  pixels_.resize(4 * width * height);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target_.id());
  for (std::size_t attachment = 0; attachment < attachments.size(); ++attachment) {
    bool is_read = false;
    for (const Part& part : parts) {
      if (part.attachment != attachment || image.find(part.channel) == nullptr) continue;
      if (!is_read) {
        glReadBuffer(attachments[attachment]);
        glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, pixels_.data());
        is_read = true;
      }
      const auto components = static_cast<std::size_t>(image.find(part.channel)->components);
      std::vector<float>& values = image.add(part.channel, static_cast<int>(components));
      for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < width; ++x) {
          const float* in = pixels_.data() + 4 * ((height - 1 - y) * width + x) + part.first;
          float* out = values.data() + components * (y * width + x) + part.component;
          for (std::size_t k = 0; k < part.count; ++k) out[k] = in[k];
        }
      }
    }
  }
  glReadBuffer(GL_COLOR_ATTACHMENT0);
}

}  // namespace lagomorph::render::raster
