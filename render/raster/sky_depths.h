#pragma once

#include <span>
#include <vector>

#include "render/raster/depth_maps.h"
#include "render/raster/frame_block.h"
#include "render/render_scene.h"

namespace lagomorph::render::raster {

/// A mesh as the sky's directions see it.
struct SkyCaster {
  std::span<const Vec3> positions;
  std::span<const Triangle> triangles;
  bool closed;    // only its front is ever seen
  float opacity;  // below 1 it is drawn as dots, see see_through_depth_map_fragment
  int body;
};

/// One parallel depth map a direction of the frame's sky, fitted (FrameBlock::sky_map): sixteen small ones of
/// triangles that are smaller than a texel, which OpenGL would transform and set up one by one on one thread.
void draw_sky_depths(const FrameBlock&, std::span<const SkyCaster>, int size, std::vector<DepthMap>&);

}  // namespace lagomorph::render::raster
