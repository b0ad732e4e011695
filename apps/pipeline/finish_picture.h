#pragma once

#include "apps/pipeline/surface_fields.h"
#include "apps/run/record.h"
#include "apps/scene/scene_desc.h"
#include "render/color.h"

namespace lagomorph::apps {

/// The picture of a rendered frame: tone curve, colour bars, caption. `state` is what is told of the frame's.
render::Picture finish_picture(const render::Image&, const SceneDesc&, const SurfaceFields&, int frame,
                               const StateRecord& state);

/// The scene's caption over a picture.
void draw_scene_caption(render::Picture&, const SceneDesc&, int frame, const StateRecord& state);

}  // namespace lagomorph::apps
