#pragma once

#include <span>
#include <string>
#include <vector>

#include "render/raster/by_rays.h"
#include "render/render_scene.h"

/// What the rasterizer draws in place of the principled material's clear and cloudy insides, coat and sheen.
namespace lagomorph::render::raster {

/// Mean length of the straight lines through a closed surface, 4 V / S (Cauchy's; of a convex body) [m].
float mean_chord(std::span<const Vec3> positions, std::span<const Triangle>);

/// A clear inside is a diffuse base of what absorption leaves of white over `thickness` [m], or black where
/// what is seen through it is drawn by rays; a cloudy one is a base of its colour, under the same dielectric.
/// Of roughness and coat_roughness the sharper one counts as far as there is coat, or where rays show what
/// that mirrors the base is darker by it. The same material where it has none of these.
Material optics_stand_in(const Material&, float thickness, ByRays);
/// Which meshes are drawn so and how, a line each.
std::vector<std::string> optics_remarks(const RenderScene&, const RasterSettings&);

}  // namespace lagomorph::render::raster
