#pragma once

#include <span>

#include "render/camera.h"
#include "render/raster/ray_scene.h"
#include "render/raster/view_range.h"

/// What OpenGL cannot draw of smooth surfaces, by rays, refracted and mirrored, that end in the pictures that
/// are there already. `color`: linear, interleaved, rows from the top.
namespace lagomorph::render::raster {

/// Adds what is seen through clear meshes, and mirrored by smooth ones, in a rectangle to the whole picture,
/// which has all else of them, `multisample` as OpenGL draws it.
void add_by_rays(const RayScene&, const Camera&, const DrawnPictures&, const PixelRectangle&, int multisample,
                 std::span<float> color);
/// Puts what the ground mirrors of meshes into the picture without meshes, in place of the sky behind them.
void add_mirrored_by_ground(const RayScene&, const Camera&, const DrawnPictures&, const PixelRectangle&,
                            std::span<float> color);

}  // namespace lagomorph::render::raster
