#pragma once

#include <span>

#include "apps/overlay/wireframe.h"

namespace lagomorph::apps {

struct GhostStyle {
  bool fill = true, outline = true;
  Color color = {0, 0, 0};
  double opacity = 0.35;  // of the fill where it is seen from the side; less where from the front
  bool over = false;      // things do not hide it
};

/// Draws a translucent shape that is not there: the surface that is in front of it and its contours, sharp
/// edges and borders. One layer whatever the order of its triangles.
void draw_ghost(render::Picture&, const View& things, const LineMesh&,
                std::span<const render::Vec3> positions, const GhostStyle&);

/// Edges where a surface turns away from the eye, ends or bends by more than 50 degrees.
std::vector<std::array<std::uint32_t, 2>> contours(const LineMesh&, std::span<const render::Vec3> positions,
                                                   const render::Camera&);

}  // namespace lagomorph::apps
