#pragma once

#include <string>
#include <vector>

#include "render/camera.h"
#include "render/render_scene.h"

/// What the rasterizer draws in place of what it cannot.
namespace lagomorph::render::raster {

/// The scene without its meshes' triangles: suns are far squares of their solid angle and irradiance, the
/// last ones of its lights, and a map of the sky is the gradient that gives the same light to what faces up
/// and, in the mean, to what faces sideways.
RenderScene with_stand_ins(const RenderScene&);
/// What is drawn otherwise than by the path tracer, a line each.
std::vector<std::string> stand_in_remarks(const CameraSettings&, const RenderScene&);

/// Solid angle of a sun [sr].
float solid_angle(const Sun&);
/// Zenith and horizon that stand for a map, with strength 1.
Sky gradient_of(const SkyMap&);

}  // namespace lagomorph::render::raster
