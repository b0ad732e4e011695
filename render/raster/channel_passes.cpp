#include "render/raster/channel_passes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "render/raster/shaders/shaders.h"

namespace lagomorph::render::raster {
namespace {

void begin_values(Targets& targets, float nothing) {
  targets.bind_depth();
  glEnable(GL_DEPTH_TEST);
  const std::array<float, 4> color = {nothing, 0.0F, 0.0F, 0.0F};
  glClearBufferfv(GL_COLOR, 0, color.data());
  glClear(GL_DEPTH_BUFFER_BIT);
}

}  // namespace

void ChannelPasses::set_scene(const LightFeatures& features, bool colors) {
  if (!(features == features_)) {
    alpha_.reset();
    data_.reset();
  }
  features_ = features;
  colors_ = colors;
}

bool ChannelPasses::wants(const char* channel) const {
  return std::find(settings_.channels.begin(), settings_.channels.end(), channel) != settings_.channels.end();
}

void ChannelPasses::draw(const SceneShapes& shapes, const View& view, Targets& targets, Image& image) {
  if (wants(depth_channel)) draw_depth(shapes, view.has_ground, targets, image);
  if (wants(body_id_channel)) draw_body_ids(shapes, view.has_ground, targets, image);
  if (has_alpha()) draw_alpha(shapes, view.caught, targets, image);
  draw_data(shapes, view, image);
}

const DepthPrograms& ChannelPasses::depth_programs() {
  if (!depth_) depth_.emplace();
  return *depth_;
}

void ChannelPasses::draw_depth(const SceneShapes& shapes, bool has_ground, Targets& targets, Image& image) {
  const DepthPrograms& programs = depth_programs();
  begin_values(targets, std::numeric_limits<float>::infinity());
  shapes.draw_meshes(programs.mesh);
  if (has_ground) shapes.draw_ground(programs.ground);
  targets.read_values(image.add(depth_channel, 1));
}

/// The meshes' numbers from 1 on; the ground hides them and has none.
void ChannelPasses::draw_body_ids(const SceneShapes& shapes, bool has_ground, Targets& targets,
                                  Image& image) {
  if (!mesh_number_) {
    mesh_number_.emplace("mesh number", Program::Parts{shaders::frame, shaders::mesh_vertex},
                         Program::Parts{shaders::frame, shaders::mesh_number_fragment});
  }
  begin_values(targets, 0.0F);
  if (has_ground) {
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    shapes.draw_ground(depth_programs().ground);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }
  shapes.draw_meshes(*mesh_number_);
  std::vector<float>& ids = image.add(body_id_channel, 1);
  targets.read_values(ids);
  for (float& id : ids) {
    id = id > 0.0F ? static_cast<float>(shapes.meshes()[static_cast<std::size_t>(id) - 1].body_id()) : -1.0F;
  }
}

void ChannelPasses::draw_alpha(const SceneShapes& shapes, std::span<const float> caught, Targets& targets,
                               Image& image) {
  if (!alpha_) {
    const std::string samples = "#define SAMPLES " + std::to_string(settings_.raster.multisample) + "\n" +
                                (features_.see_through ? "#define PEEL\n" : "");
    alpha_.emplace(
        "alpha", Program::Parts{shaders::full_screen_vertex},
        Program::Parts{samples.c_str(), shaders::frame, shaders::ground_point, shaders::alpha_fragment});
  }
  targets.bind_depth();
  targets.bind_seen_textures();
  if (features_.see_through) targets.bind_peeled_color_texture();
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  alpha_->use();
  glUniform1i(alpha_->location("catches_shadows"), caught.empty() ? 0 : 1);
  shapes.draw_full_screen();
  std::vector<float>& alpha = image.add(alpha_channel, 1);
  targets.read_values(alpha);
  for (std::size_t i = 0; i < caught.size(); ++i) alpha[i] += (1.0F - alpha[i]) * caught[i];
}

/// Those of DataPass.
void ChannelPasses::draw_data(const SceneShapes& shapes, const View& view, Image& image) {
  const std::size_t others = image.channels().size();
  for (const char* channel :
       {normal_channel, albedo_channel, position_channel, motion_channel, triangle_id_channel}) {
    if (wants(channel)) image.add(channel, channel_kind(channel).components);
  }
  if (image.channels().size() == others) return;
  if (!data_ || data_->width() != image.width() || data_->height() != image.height() ||
      data_->colors() != colors_) {
    data_.reset();
    data_.emplace(image.width(), image.height(), colors_, features_);
  }
  data_->begin(view.clip_before);
  if (view.has_ground) shapes.draw_ground(data_->ground());
  shapes.draw_meshes(data_->mesh());
  data_->read(image);
}

}  // namespace lagomorph::render::raster
