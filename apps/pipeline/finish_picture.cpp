#include "apps/pipeline/finish_picture.h"

#include <utility>
#include <vector>

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

render::Picture finish_picture(const RenderedFrame& frame, const SceneDesc& scene,
                               const SurfaceFields& fields, const Overlays& overlays) {
  render::Picture picture =
      render::tone_map(frame.image, scene.render.tone_curve, scene.render.exposure, scene.render.transparent);
  overlay(picture, [&](render::Picture& on) {
    overlays.draw(on, frame.camera, frame.state);
    std::vector<ColorBar> bars = fields.bars();
    for (ColorBar& bar : overlays.bars()) bars.push_back(std::move(bar));
    const double beside = draw_color_bars(on, bars);
    const std::string caption =
        caption_text(scene.caption.text, caption_values(scene, frame.state.frame, frame.told));
    double above = 0.0;  // the caption, where it is in the same place
    if (scene.caption.place == scene.energy_plot.place) {
      const Rectangle plate = caption_plate(on, caption, scene.caption.place);
      if (plate.bottom > plate.top) above = plate.bottom - plate.top + overlay_unit(on);
    }
    overlays.draw_energies(on, frame.state.frame, above, beside);
    draw_caption(on, caption, scene.caption.place);
  });
  return picture;
}

void draw_scene_caption(render::Picture& picture, const SceneDesc& scene, int frame,
                        const StateRecord& state) {
  overlay(picture, [&](render::Picture& on) {
    draw_caption(on, caption_text(scene.caption.text, caption_values(scene, frame, state)),
                 scene.caption.place);
  });
}

}  // namespace lagomorph::apps
