#pragma once

#include <array>
#include <vector>

#include "render/raster/cube_map.h"
#include "render/raster/frame_block.h"
#include "render/render_scene.h"

namespace lagomorph::render::raster {

/// The light of a map of the sky as the shaders look it up: integrals that do not depend on the meshes. Above
/// and below the horizon are kept apart, for the ground may lie before what is below.
struct SkyLight {
  /// By normal, rgb: irradiance from above the horizon, and the mean radiance from below, weighed by the
  /// cosine.
  CubeMap<Vec4> irradiance_above, radiance_below;
  /// By direction of the mirrored view, a level for each of sky_lobe_levels roughnesses from 0 to 1, each
  /// half as large as the one before: mean radiance of the GGX lobe with the half that it does not see black;
  /// w: part of the lobe above (of `lobes_above`).
  std::vector<CubeMap<Vec4>> lobes_above, lobes_below;
  /// Parts of the sky above the horizon, smaller where it is bright: each one's direction is the middle of
  /// its light.
  std::array<SkyDirectionBlock, most_sky_directions> directions;
};

constexpr int sky_lobe_levels = 5;

/// Of a sky that has a map, times its strength. The lobes are those of the split sum [Karis 2013].
SkyLight sky_light(const Sky&);

/// The map with texels of the mean of some, so that it is no wider than that.
SkyMap reduced(const SkyMap&, int most_width);

}  // namespace lagomorph::render::raster
