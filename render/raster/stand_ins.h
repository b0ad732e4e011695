#pragma once

#include <string>
#include <vector>

#include "render/camera.h"
#include "render/render_scene.h"

/// What the rasterizer draws in place of what it cannot.
namespace lagomorph::render::raster {

/// The scene without its meshes' triangles: suns are far squares of their solid angle and irradiance, the
/// last ones of its lights.
RenderScene with_stand_ins(const RenderScene&);
/// What is drawn otherwise than by the path tracer, a line each.
std::vector<std::string> stand_in_remarks(const CameraSettings&, const RenderScene&);

/// Solid angle of a sun [sr].
float solid_angle(const Sun&);

}  // namespace lagomorph::render::raster
