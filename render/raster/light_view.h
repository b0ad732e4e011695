#pragma once

#include <span>
#include <vector>

#include "render/raster/frame_block.h"
#include "render/render_scene.h"

namespace lagomorph::render::raster {

/// How a light's shadow map sees the meshes: from the rectangle's centre, with its axes.
struct LightView {
  Mat4 clip_from_world = Mat4::Identity();
  Vec4 map = Vec4(1.0F, 1.0F, 0.5F, 0.5F);  // LightBlock::map
  Vec4 depth = Vec4::Zero();                // LightBlock::depth; all 0: the light meets no mesh
  int size = 0;                             // of the map, along a side [texels]
};

/// Fits the view around all positions. The borders are multiples of a sixteenth of the view or so, so that
/// they stand still while the meshes move a little: a pure function of the positions all the same.
LightView fit_light_view(const AreaLight&, std::span<const std::vector<Vec3>> positions, int map_size);
/// From another point of the light's plane; what is nearer to that than `nearest` [m] is cut off.
LightView fit_light_view(const Vec3& from, const LightFrame&, float nearest,
                         std::span<const std::vector<Vec3>> positions, int map_size);

}  // namespace lagomorph::render::raster
