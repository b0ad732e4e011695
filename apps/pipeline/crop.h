#pragma once

#include "render/color.h"
#include "render/image.h"
#include "render/settings.h"

/// Parts of pictures.
namespace lagomorph::apps {

render::Channel cropped(const render::Channel&, const render::PixelRegion&);
/// Of channels with a value a pixel.
render::Image cropped(const render::Image&, const render::PixelRegion&);
render::Picture cropped(render::Picture, const render::PixelRegion&);

}  // namespace lagomorph::apps
