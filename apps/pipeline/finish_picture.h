#pragma once

#include <array>
#include <map>
#include <string>

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

/// The ranges that the pictures of a sequence have in common: of fields by the body's name, of overlays by
/// theirs.
std::map<std::string, std::array<double, 2>> picture_ranges(const SurfaceFields&, const Overlays&);

/// Its picture: tone curve, overlays, colour bars, diagram, caption.
render::Picture finish_picture(const RenderedFrame&, const SceneDesc&, const SurfaceFields&, const Overlays&);

}  // namespace lagomorph::apps
