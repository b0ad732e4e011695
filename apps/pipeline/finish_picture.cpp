#include "apps/pipeline/finish_picture.h"

#include "apps/overlay/caption.h"
#include "apps/overlay/color_bar.h"

namespace lagomorph::apps {
namespace {

CaptionValues caption_values(const SceneDesc& scene, int frame, const StateRecord& state) {
  return {.name = scene.name,
          .frame = frame,
          .frames = scene.time.frames,
          .time = state.time,
          .kinetic = state.energy.kinetic,
          .elastic = state.energy.elastic,
          .gravitational = state.energy.gravitational,
          .total = state.energy.total(),
          .iterations = state.report.newton_iterations,
          .min_J = state.min_J};
}

}  // namespace

render::Picture finish_picture(const RenderedFrame& frame, const SceneDesc& scene,
                               const SurfaceFields& fields, const Overlays& overlays) {
  render::Picture picture = render::tone_map(frame.image, scene.render.tone_curve, scene.render.exposure);
  overlays.draw(picture, frame.camera, frame.state);
  draw_color_bars(picture, fields.bars());
  draw_caption(picture,
               caption_text(scene.caption.text, caption_values(scene, frame.state.frame, frame.told)),
               scene.caption.place);
  return picture;
}

}  // namespace lagomorph::apps
