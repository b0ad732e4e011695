#pragma once

#include <optional>

#include "render/raster/frame_block.h"

namespace lagomorph::render::raster {

/// The ray through a point of the picture [pixels from the lower left corner]; the direction has length 1
/// along the view axis. As pixel_ray() of the shaders.
struct PixelRay {
  Vec3 origin, direction;
};
PixelRay pixel_ray(const FrameBlock&, float x, float y);

/// Where that meets the ground's plane, and the depth along the view axis; nothing where it does not. As
/// meet_ground() of the shaders.
struct GroundPoint {
  Vec3 point;
  float depth;
};
std::optional<GroundPoint> ground_at_pixel(const FrameBlock&, float x, float y);

/// Whether its upper side is seen.
bool ground_is_below(const FrameBlock&);

}  // namespace lagomorph::render::raster
