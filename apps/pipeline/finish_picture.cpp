#include "apps/pipeline/finish_picture.h"

#include "apps/overlay/caption.h"
#include "apps/overlay/color_bar.h"
#include "apps/overlay/matte.h"

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

render::Picture finish_picture(const render::Image& image, const SceneDesc& scene,
                               const SurfaceFields& fields, int frame, const StateRecord& state) {
  render::Picture picture =
      render::tone_map(image, scene.render.tone_curve, scene.render.exposure, scene.render.transparent);
  overlay(picture, [&](render::Picture& on) {
    draw_color_bars(on, fields.bars());
    draw_caption(on, caption_text(scene.caption.text, caption_values(scene, frame, state)),
                 scene.caption.place);
  });
  return picture;
}

}  // namespace lagomorph::apps
