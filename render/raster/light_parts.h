#pragma once

#include <span>

#include "render/raster/frame_block.h"
#include "render/render_scene.h"

namespace lagomorph::render::raster {

constexpr int most_parts_along = 6;  // a side

/// The equal rectangles that a light is seen as: a depth map from its middle knows only what hides that, and
/// of what hides it only a mean distance, which does for what is small beside its distance from the meshes.
struct LightSplit {
  int across = 1, up = 1;     // along its width and height
  bool below_ground = false;  // some of it is below the ground, which hides it

  int count() const { return across * up; }
};

/// Decided by where the meshes are when the scene is given, not by how they move: a change of it would show.
LightSplit split_of(const AreaLight&, std::span<const Mesh>, const Ground&);

/// Of the far square that stands for a sun: as far from all meshes, however they move.
LightSplit split_of_sun(float solid_angle);

/// Rectangle k of a light, row by row.
LightBlock part_of(const LightBlock& light, const LightSplit&, int k);

}  // namespace lagomorph::render::raster
