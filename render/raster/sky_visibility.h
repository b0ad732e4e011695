#pragma once

#include "render/raster/depth_maps.h"
#include "render/raster/frame_block.h"
#include "render/raster/pixel_block.h"

namespace lagomorph::render::raster {

/// Part of the sky's light that the meshes leave: of what falls on the surface, and of what is mirrored; and
/// of the light from below the horizon that is mirrored.
struct SkySeen {
  Lanes3 diffuse, mirrored;
  Lanes below;
};
/// Through the middle of each direction's part of the sky.
void sky_seen(const FrameBlock&, const DepthMaps&, const Receivers&, SkySeen&);
/// The same (but for what is mirrored) where a plane would show the edges of each direction's shadow: a
/// direction stands for all within some 20 degrees of it, and what hides it is looked for, then measured,
/// within the spread that they have at its distance.
void sky_seen_softly(const FrameBlock&, const DepthMaps&, const Receivers&, SkySeen&);

}  // namespace lagomorph::render::raster
