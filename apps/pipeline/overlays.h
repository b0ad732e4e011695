#pragma once

#include <string>
#include <vector>

#include "apps/overlay/view.h"
#include "apps/pipeline/body_lines.h"
#include "apps/scene/scene_desc.h"
#include "render/camera.h"
#include "render/color.h"
#include "sim/model.h"
#include "sim/surface.h"

namespace lagomorph::apps {

/// Lines and signs that a scene draws over its pictures, in the world and hidden by what is in front of them.
/// Back ends have no part in them. Safe to use from many threads.
class Overlays {
public:
  /// All are referred to; surfaces are those that are drawn.
  Overlays(const SceneDesc&, const sim::Model&, const std::vector<sim::Surface>&);

  /// Draws those of a state over its picture.
  void draw(render::Picture&, const render::Camera&, const sim::State&) const;

private:
  /// Everything solid that a renderer draws.
  View view_of(const render::Camera&, const sim::VecX& q) const;
  void draw_wireframes(render::Picture&, const View&, const sim::VecX& q) const;

  const SceneDesc& scene_;
  const std::vector<sim::Surface>& surfaces_;
  std::vector<BodyLines> drawn_;       // a body each; empty where it has no fill
  std::vector<BodyLines> wireframes_;  // likewise; empty where none is shown
};

/// What of the scene's overlays has no effect, a line each.
std::vector<std::string> overlay_remarks(const SceneDesc&);

}  // namespace lagomorph::apps
