#pragma once

#include "apps/pipeline/overlays.h"
#include "apps/pipeline/surface_fields.h"
#include "apps/run/record.h"
#include "apps/scene/scene_desc.h"
#include "render/camera.h"
#include "render/color.h"
#include "render/image.h"
#include "sim/model.h"

namespace lagomorph::apps {

/// A frame as a renderer drew it.
struct RenderedFrame {
  const render::Image& image;
  const render::Camera& camera;
  const sim::State& state;
  const StateRecord& told;  // of the state
};

/// Its picture: tone curve, overlays, colour bars, diagram, caption.
render::Picture finish_picture(const RenderedFrame&, const SceneDesc&, const SurfaceFields&, const Overlays&);

/// The scene's caption over a picture.
void draw_scene_caption(render::Picture&, const SceneDesc&, int frame, const StateRecord& state);

}  // namespace lagomorph::apps
