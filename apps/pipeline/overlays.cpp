#include "apps/pipeline/overlays.h"

#include <algorithm>

#include <fmt/format.h>

namespace lagomorph::apps {
namespace {

LineStyle style_of(const WireframeDesc& w) {
  return {.color = srgb_color(w.color), .width = w.width, .opacity = w.opacity, .hidden = w.hidden};
}

bool has_any(const std::vector<BodyLines>& all) {
  return std::any_of(all.begin(), all.end(), [](const BodyLines& b) { return !b.mesh.edges.empty(); });
}

}  // namespace

Overlays::Overlays(const SceneDesc& scene, const sim::Model& model, const std::vector<sim::Surface>& surfaces)
    : scene_(scene), surfaces_(surfaces), drawn_(scene.body.size()), wireframes_(scene.body.size()) {
  for (std::size_t i = 0; i < scene.body.size(); ++i) {
    const BodyDesc& body = scene.body[i];
    if (body.wireframe.show) wireframes_[i] = lines_of(scene, model, surfaces, i, body.wireframe.of);
  }
  if (!has_any(wireframes_)) return;
  for (std::size_t i = 0; i < scene.body.size(); ++i)
    if (scene.body[i].surface.fill) drawn_[i] = lines_of_surface(surfaces_[i]);
}

View Overlays::view_of(const render::Camera& camera, const sim::VecX& q) const {
  View view(camera, scene_.ground);
  int first_item = 0;
  for (const BodyLines& body : drawn_) {
    if (body.mesh.triangles.empty()) continue;
    view.items().draw(body.mesh.triangles, positions_of(body, q), first_item);
    first_item += static_cast<int>(body.mesh.triangles.size());
  }
  return view;
}

void Overlays::draw_wireframes(render::Picture& picture, const View& view, const sim::VecX& q) const {
  for (std::size_t i = 0; i < wireframes_.size(); ++i) {
    const BodyLines& lines = wireframes_[i];
    if (lines.mesh.edges.empty()) continue;
    const std::vector<render::Vec3> x = positions_of(lines, q);
    View with_own = view;  // a mesh hides its own lines, whether it is filled or not
    with_own.items().draw(lines.mesh.triangles, x, own_items(i));
    draw_wireframe(picture, with_own, lines.mesh, x, own_items(i), style_of(scene_.body[i].wireframe));
  }
}

void Overlays::draw(render::Picture& picture, const render::Camera& camera, const sim::State& state) const {
  if (!has_any(wireframes_)) return;
  draw_wireframes(picture, view_of(camera, state.q), state.q);
}

std::vector<std::string> overlay_remarks(const SceneDesc& scene) {
  std::vector<std::string> remarks;
  const auto shows_field = [](const BodyDesc& body) { return body.shown.field != "none"; };
  if (scene.clip && scene.clip->color && std::all_of(scene.body.begin(), scene.body.end(), shows_field))
    remarks.emplace_back("clip.color has no effect: the bodies' fields colour the cut");
  for (std::size_t i = 0; i < scene.body.size(); ++i) {
    const BodyDesc& body = scene.body[i];
    if (!body.surface.fill && !body.wireframe.show) {
      remarks.push_back(
          fmt::format("body.{}.surface.fill = false without body.{}.wireframe.show: nothing of '{}' is drawn",
                      i, i, body.physics.name));
    }
  }
  return remarks;
}

}  // namespace lagomorph::apps
