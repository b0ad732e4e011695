#include "render/raster/pixel_ray.h"

namespace lagomorph::render::raster {

PixelRay pixel_ray(const FrameBlock& frame, float x, float y) {
  const Vec3 across = (2.0F * x * frame.viewport[2] - 1.0F) * frame.right.head<3>() +
                      (2.0F * y * frame.viewport[3] - 1.0F) * frame.up.head<3>();
  const bool parallel = frame.eye.w() > 0.5F;
  return {frame.eye.head<3>() + (parallel ? across : Vec3::Zero()),
          frame.forward.head<3>() + (parallel ? Vec3::Zero() : across)};
}

std::optional<GroundPoint> ground_at_pixel(const FrameBlock& frame, float x, float y) {
  const PixelRay ray = pixel_ray(frame, x, y);
  const float depth = (frame.ground.x() - ray.origin.y()) / ray.direction.y();
  if (!(depth > 0.0F && depth < 1e9F)) return std::nullopt;
  GroundPoint ground = {ray.origin + depth * ray.direction, depth};
  ground.point.y() = frame.ground.x();
  return ground;
}

bool ground_is_below(const FrameBlock& frame) {
  return frame.eye.w() > 0.5F ? frame.forward.y() < 0.0F : frame.eye.y() > frame.ground.x();
}

}  // namespace lagomorph::render::raster
