#include "render/raster/body_pass.h"

#include <array>

namespace lagomorph::render::raster {
namespace {

constexpr int most_peels = 256;  // surfaces that are not opaque, one behind the other
constexpr std::array<float, 4> no_color = {};

}  // namespace

void BodyPass::set_scene(const std::vector<AreaLight>& lights, const LightFeatures& features, bool colors) {
  lights_ = lights;
  colors_ = colors;
  if (!(features == features_)) {
    features_ = features;
    for (auto& programs : seen_) programs.reset();
    for (auto& programs : peel_) programs.reset();
  }
  const std::size_t kind = colors ? 1 : 0;
  if (!programs_) programs_.emplace(multisample_);
  if (!seen_[kind]) seen_[kind].emplace(multisample_, colors, features);
  if (features.see_through && !peel_[kind]) peel_[kind].emplace(multisample_, colors, features);
}

void BodyPass::draw(const SceneShapes& shapes, Which which, const View& view, Targets& targets) {
  glScissor(view.seen.x, view.seen.y, view.seen.width, view.seen.height);
  glEnable(GL_SCISSOR_TEST);
  targets.bind_color();
  glClearBufferfv(GL_COLOR, 0, no_color.data());
  draw_seen(shapes, which, view.behind_ground, targets);
  targets.bind_seen_textures();
  const Program* plain = seen().plain && !view.behind_ground ? &*seen().plain : nullptr;
  draw_layers(shapes, view, {programs_->surface, seen().layer, plain, GL_ONE_MINUS_SRC_ALPHA, false},
              targets);
  if (features_.see_through) draw_see_through(shapes, view, targets);
  glDisable(GL_SCISSOR_TEST);
  targets.read_color(view.seen);
}

/// What is seen of meshes and visible lights, unlit, in every sample.
void BodyPass::draw_seen(const SceneShapes& shapes, Which which, bool behind_ground,
                         const Targets& targets) const {
  targets.bind_seen();
  glEnable(GL_DEPTH_TEST);
  targets.clear_seen();
  if (behind_ground) {
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    shapes.draw_ground(programs_->ground_cover);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }
  shapes.draw_meshes(seen().mesh, which);
  shapes.draw_lights(seen().light, lights_);
}

/// The bound samples that are seen, lit once a pixel and surface, into the picture or that of the peeled
/// surfaces: layers add up, by what `weight_of_drawn` leaves of those before; where that is their cover, the
/// first covers for all.
void BodyPass::draw_layers(const SceneShapes& shapes, const View& view, const LayerPass& pass,
                           Targets& targets) {
  surfaces_at_ = whole_cells(view.seen);
  glDisable(GL_CULL_FACE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  targets.bind_surface();
  pass.surface.use();
  const bool plain = pass.plain != nullptr;
  glUniform1i(pass.surface.location("singles_are_plain"), plain ? 1 : 0);
  shapes.draw_full_screen();
  glDepthFunc(GL_LESS);
  targets.read_surface(surfaces_at_, surfaces_);
  if (!light_surfaces(view.block, view.depths, surfaces_at_, surfaces_, lit_)) return;
  targets.take(lit_);
  targets.bind_surface_texture();
  pass.peeled ? targets.bind_peeled_color() : targets.bind_color();
  glDepthMask(GL_FALSE);
  if (plain) {
    glDepthFunc(GL_GREATER);
    pass.plain->use();
    shapes.draw_full_screen();
    glDepthFunc(GL_LESS);
  }
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, pass.weight_of_drawn);
  pass.layer.use();
  for (int i = 0; i < multisample_; ++i) {
    glUniform1i(pass.layer.location("layer"), i);
    shapes.draw_full_screen();
  }
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
}

/// What is not opaque: surface behind surface as far as there are any, each by what those before it let
/// through. So the order in which they are drawn does not matter.
void BodyPass::draw_see_through(const SceneShapes& shapes, const View& view, Targets& targets) {
  const PeelPrograms& programs = peel();
  targets.need_peels();
  targets.bind_peeled_color();
  glDisable(GL_SCISSOR_TEST);
  glClearBufferfv(GL_COLOR, 0, no_color.data());
  glEnable(GL_SCISSOR_TEST);
  const Query query;
  for (int number = 0; number < most_peels; ++number) {
    targets.begin_peel(number % 2);
    glEnable(GL_DEPTH_TEST);
    programs.mesh.use();
    glUniform1i(programs.mesh.location("is_first"), number == 0 ? 1 : 0);
    glBeginQuery(GL_ANY_SAMPLES_PASSED, query.id());
    shapes.draw_meshes(programs.mesh, Which::see_through);
    glEndQuery(GL_ANY_SAMPLES_PASSED);
    GLuint any = 0;
    glGetQueryObjectuiv(query.id(), GL_QUERY_RESULT, &any);
    if (any == 0) break;
    targets.bind_peeled_textures(number % 2);
    draw_layers(shapes, view, {programs.surface, programs.layer, nullptr, GL_ONE, true}, targets);
  }
  targets.bind_color();
  targets.bind_peeled_color_texture();
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  programs.composite.use();
  shapes.draw_full_screen();
  glDisable(GL_BLEND);
}

}  // namespace lagomorph::render::raster
