#pragma once

#include <functional>

#include "render/color.h"

namespace lagomorph::apps {

/// Draws over a picture. What `draw` draws on knows nothing of alpha: a picture that has some is laid over
/// black and over white, drawn on twice, and colour and alpha follow from both where they have changed [Smith
/// and Blinn 1996, "Blue Screen Matting", the two-background solution].
void overlay(render::Picture&, const std::function<void(render::Picture&)>& draw);

}  // namespace lagomorph::apps
