#pragma once

#include <memory>
#include <optional>

#include "render/render_scene.h"

namespace lagomorph::render::raster {

/// A sun in a map of the sky, and the map without it.
struct SkySun {
  Sun sun;
  std::shared_ptr<const SkyMap> rest;
};

/// The small bright patch of a sky that has a map, if there is one above the horizon that gives a good part
/// of its light: what hides the sky is looked for along a few directions, which would tear such a light's
/// shadows. In its place the rest has the mean of what surrounds it; the light of both together is the map's.
std::optional<SkySun> sun_of_sky(const Sky&);

}  // namespace lagomorph::render::raster
