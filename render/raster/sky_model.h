#pragma once

#include <array>
#include <span>
#include <vector>

#include "render/coat_albedo.h"
#include "render/raster/frame_block.h"
#include "render/render_scene.h"

/// Integrals that the shaders look up: pure functions, the same for every scene.
namespace lagomorph::render::raster {

/// Irradiance of the sky above the horizon on a surface whose normal has height n.y: weight of the horizon's
/// radiance and of the zenith's. They add up to pi (1 + n.y) / 2.
struct SkyIrradiance {
  float horizon, zenith;
};
SkyIrradiance sky_irradiance(float normal_y);
/// sky_irradiance at n.y = -1 .. 1 in `entries` equal steps.
std::vector<SkyIrradiance> sky_irradiance_table(int entries);

/// A coat's albedo in a direction, and its mean over the hemisphere, 2 int albedo(c) c dc.
struct CoatTableEntry {
  CoatAlbedo direction, mean;
};
/// entries x entries, cos_view fastest, both at the middles of equal steps over [0, 1].
std::vector<CoatTableEntry> coat_albedo_table(int entries);

/// Of a sheen, see path::Sheen.
struct SheenTableEntry {
  float albedo, power, scale, unused;
};
/// A row of `entries` a roughness, at cosines 0 .. 1 in equal steps.
std::vector<SheenTableEntry> sheen_table(std::span<const float> roughnesses, int entries);

/// Directions that share the upper hemisphere evenly, each with two axes across and the sky's radiance.
std::array<SkyDirectionBlock, most_sky_directions> sky_directions(const Sky&);

}  // namespace lagomorph::render::raster
