#pragma once

#include <span>
#include <vector>

#include "render/raster/depth_maps.h"
#include "render/raster/frame_block.h"
#include "render/raster/light_view.h"
#include "render/render_scene.h"

namespace lagomorph::render::raster {

/// A mesh as light sees it.
struct Caster {
  std::span<const Vec3> positions;
  std::span<const Triangle> triangles;
  bool closed;    // only its front is ever seen
  float opacity;  // below 1 it is drawn as dots, as dense as it is opaque
  int body;
};

// Depth maps are drawn on the CPU: OpenGL would set up triangles that are hardly larger than a texel one by
// one, on one thread, and its maps would have to be read back. The same bits on every processor.

/// One parallel depth map a direction of the frame's sky, fitted (FrameBlock::sky_map), and one of the same
/// texels seen the other way, its depths from the far end, where it is asked for.
void draw_sky_depths(const FrameBlock&, std::span<const Caster>, int size, std::vector<DepthMap>&,
                     std::vector<DepthMap>* from_below = nullptr);

/// One map a view in perspective, depths from near to far; what is nearer than near is cut off. Their sizes
/// are multiples of 256.
void draw_light_depths(std::span<const LightView>, std::span<const Caster>, std::vector<DepthMap>&);

}  // namespace lagomorph::render::raster
