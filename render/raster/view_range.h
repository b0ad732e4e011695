#pragma once

#include <span>
#include <vector>

#include "render/camera.h"
#include "render/render_scene.h"
#include "render/settings.h"

namespace lagomorph::render::raster {

/// Distances of the near and far plane [m].
struct ViewRange {
  float near = 0.1F;
  float far = 1.0F;
};

/// Around everything that is before the camera, so that the depth buffer is spent on that: all positions, the
/// ground's disc and the visible lights. What is nearer to a perspective camera than 1e-4 of the farthest is
/// cut off.
ViewRange view_range(const Camera&, std::span<const std::vector<Vec3>> positions, const RenderScene&);

/// A rectangle of pixels from the lower left corner, as OpenGL counts.
struct PixelRectangle {
  int x = 0, y = 0, width = 0, height = 0;
};

/// Where the meshes and visible lights can be seen: a pixel or two larger than their projections.
PixelRectangle seen_rectangle(const Camera&, std::span<const std::vector<Vec3>> positions,
                              const RenderScene&);

/// Where the ground may mirror the meshes.
PixelRectangle mirrored_rectangle(const Camera&, std::span<const std::vector<Vec3>> positions,
                                  const RenderScene&);

/// Whether the ground may hide something: it is seen from below, or something is under it.
bool ground_may_hide(const Camera&, std::span<const std::vector<Vec3>> positions, const Ground&);

/// A region of a picture of this height.
PixelRectangle rectangle_of(const PixelRegion&, int height);
/// Empty (of no width and height) where they do not meet.
PixelRectangle common_rectangle(const PixelRectangle&, const PixelRectangle&);

}  // namespace lagomorph::render::raster
