#pragma once

#include <vector>

#include "apps/overlay/view.h"
#include "render/color.h"

namespace lagomorph::apps {

/// An arrow in the world.
struct Arrow {
  render::Vec3 from, to;  // [m]
  Color color = {255, 255, 255};
  double head = 0.02;  // its length [m]; less on short arrows
};

/// Draws arrows as flat signs with a dark rim, the furthest first; what is behind something faintly, unless
/// nothing hides them.
void draw_arrows(render::Picture&, const View&, std::vector<Arrow>, bool hidden_by_things = true);

/// A dot on a surface, a ring where `hollow`.
struct Dot {
  render::Vec3 at;  // [m]
  Color color = {255, 255, 255};
  double diameter = 0.02;  // [m]
  bool hollow = false;
  bool visible = true;  // false: faint
};
/// Likewise; at least 5 pixels wide.
void draw_dots(render::Picture&, const render::Camera&, std::vector<Dot>);

}  // namespace lagomorph::apps
