#include "apps/pipeline/finish_picture.h"

#include <algorithm>
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

/// Arrows have their name, where a body shows the same.
std::vector<ColorBar> with_those_of(const Overlays& overlays, std::vector<ColorBar> bars) {
  for (ColorBar& bar : overlays.bars()) {
    const auto same = [&](const ColorBar& b) { return b.title == bar.title; };
    if (std::any_of(bars.begin(), bars.end(), same)) bar.title = "arrows: " + bar.title;
    bars.push_back(std::move(bar));
  }
  return bars;
}

}  // namespace

std::vector<ColorBar> bars_of(const SurfaceFields& fields, const Overlays& overlays) {
  return with_those_of(overlays, fields.bars());
}

render::Picture finish_picture(const RenderedFrame& frame, const SceneDesc& scene,
                               const SurfaceFields& fields, const Overlays& overlays, OverlayLayout layout) {
  render::Picture picture = render::tone_map(frame.image, scene.render.tone_curve, scene.render.exposure,
                                             scene.render.transparent, scene.render.dither);
  const std::vector<ColorBar> bars = with_those_of(overlays, fields.bars(frame.state.q));
  const std::vector<Rectangle> bar_plates = place_color_bars(layout, bars);
  const std::optional<Caption> caption = place_caption(
      layout, caption_text(scene.caption.text, caption_values(scene, frame.state.frame, frame.told)),
      scene.caption.place);
  overlay(picture, [&](render::Picture& on) {
    overlays.draw(on, frame.camera, frame.state);
    draw_color_bars(on, bars, bar_plates);
    if (caption) draw_caption(on, *caption);
    OverlayLayout left = layout;  // this may be called twice
    overlays.draw_energies(on, left, frame.state.frame);
  });
  return picture;
}

SceneCaption::SceneCaption(const SceneDesc& scene, int frame, const StateRecord& state) {
  OverlayLayout layout(scene.render.width, scene.render.height);
  placed_ = place_caption(layout, caption_text(scene.caption.text, caption_values(scene, frame, state)),
                          scene.caption.place);
}

std::optional<Rectangle> SceneCaption::plate() const {
  if (!placed_) return std::nullopt;
  return placed_->plate;
}

void SceneCaption::draw(render::Picture& picture) const {
  if (!placed_) return;
  overlay(picture, [&](render::Picture& on) { draw_caption(on, *placed_); });
}

}  // namespace lagomorph::apps
