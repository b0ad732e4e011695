#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/overlay/caption.h"
#include "apps/overlay/color_bar.h"
#include "apps/overlay/layout.h"
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

/// Its picture: tone curve, overlays, colour bars, caption, diagram, these three where the layout has room.
render::Picture finish_picture(const RenderedFrame&, const SceneDesc&, const SurfaceFields&, const Overlays&,
                               OverlayLayout);

/// What is told of the values in pictures, but for whether one shows some beyond a given range.
std::vector<ColorBar> bars_of(const SurfaceFields&, const Overlays&);

/// The scene's caption over a picture.
class SceneCaption {
public:
  SceneCaption(const SceneDesc&, int frame, const StateRecord& state);
  /// Where it stands; nothing in a picture that is too small for it.
  std::optional<Rectangle> plate() const;
  void draw(render::Picture&) const;

private:
  std::optional<Caption> placed_;
};

}  // namespace lagomorph::apps
