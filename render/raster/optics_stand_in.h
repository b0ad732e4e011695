#pragma once

#include <string>
#include <vector>

#include "render/render_scene.h"

/// What the rasterizer draws in place of the principled material's clear and cloudy insides, coat and sheen.
namespace lagomorph::render::raster {

/// A clear inside is a diffuse base of what absorption leaves over absorption_distance, a cloudy one of its
/// colour, under the same dielectric; of roughness and coat_roughness the sharper one counts as far as there
/// is coat; sheen is left out. The same material where it has none of these.
Material optics_stand_in(const Material&);
/// Which meshes are drawn so and how, a line each.
std::vector<std::string> optics_remarks(const RenderScene&);

}  // namespace lagomorph::render::raster
