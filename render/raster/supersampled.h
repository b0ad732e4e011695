#pragma once

#include <functional>
#include <memory>

#include "render/renderer.h"

namespace lagomorph::render::raster {

using MakeRenderer = std::function<std::unique_ptr<Renderer>(const RenderSettings&)>;

/// Draws the picture, and its alpha, `raster.supersample` times as wide and high and takes the mean of each
/// square, so that highlights and textures are smooth as well as edges. The other channels, which have no
/// mean, are those of the pixels' centres as without it. `make` makes renderers without supersampling.
std::unique_ptr<Renderer> make_supersampled(const RenderSettings&, const MakeRenderer& make);

}  // namespace lagomorph::render::raster
