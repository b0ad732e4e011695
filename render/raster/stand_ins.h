#pragma once

#include <string>
#include <vector>

#include "render/camera.h"
#include "render/render_scene.h"

/// What the rasterizer draws in place of what it cannot.
namespace lagomorph::render::raster {

/// The scene without its meshes' triangles: suns are far squares of their solid angle and irradiance, the
/// last ones of its lights. Of more lights and suns than can be drawn the strongest ones are there, in their
/// order. A small sun in the map of the sky is one of the suns, the last, and the map is without it: that is
/// for light alone, what is seen is the scene's. A light's strength is its area times its radiance's
/// luminance; a sun's is its irradiance's luminance times d^2, the strength of a small light that shines as
/// brightly from the distance d, which is the median of the lights' from the meshes' middle.
RenderScene with_stand_ins(const RenderScene&);
/// What is drawn otherwise than by the path tracer, a line each.
std::vector<std::string> stand_in_remarks(const CameraSettings&, const RenderScene&);

/// Solid angle of a sun [sr].
float solid_angle(const Sun&);

}  // namespace lagomorph::render::raster
