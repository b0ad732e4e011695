#include "apps/pipeline/views.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "apps/pipeline/build_scene.h"
#include "apps/pipeline/crop.h"
#include "apps/pipeline/finish_picture.h"
#include "apps/scene/shutter.h"
#include "render/channels.h"

namespace lagomorph::apps {
namespace {

std::vector<SceneDesc> scenes_of(const SceneDesc& scene) {
  std::vector<SceneDesc> scenes;
  for (std::size_t i = 0; i < panel_places(scene).size(); ++i) scenes.push_back(panel_scene(scene, i));
  return scenes;
}

/// What a channel holds between panels.
float nothing_in(const std::string& channel) {
  if (channel == render::depth_channel || channel == render::denoising_depth_channel)
    return std::numeric_limits<float>::infinity();
  return channel == render::body_id_channel || channel == render::triangle_id_channel ? -1.0F : 0.0F;
}

/// Puts the channels of a panel to their place in the picture's.
void paste(const render::Image& panel, const PanelPlace& place, render::Image& whole) {
  for (const render::Channel& channel : panel.channels()) {
    const auto n = static_cast<std::size_t>(channel.components);
    const bool is_new = whole.find(channel.name) == nullptr;
    std::vector<float>& values = whole.add(channel.name, channel.components);
    if (is_new) std::fill(values.begin(), values.end(), nothing_in(channel.name));
    const std::size_t row = n * static_cast<std::size_t>(place.width);
    for (int y = 0; y < place.height; ++y) {
      const auto from = channel.values.begin() + static_cast<std::ptrdiff_t>(row) * y;
      const std::ptrdiff_t to = static_cast<std::ptrdiff_t>(n) *
                                (static_cast<std::ptrdiff_t>(place.y + y) * whole.width() + place.x);
      std::copy(from, from + static_cast<std::ptrdiff_t>(row), values.begin() + to);
    }
  }
}

/// `components` values a pixel of a panel, to their place in a picture of that width.
void paste(const std::vector<std::uint8_t>& panel, const PanelPlace& place, int components, int width,
           std::vector<std::uint8_t>& whole) {
  const std::ptrdiff_t row = std::ptrdiff_t{components} * place.width;
  for (int y = 0; y < place.height; ++y) {
    const auto from = panel.begin() + row * y;
    std::copy(from, from + row,
              whole.begin() + components * (static_cast<std::ptrdiff_t>(place.y + y) * width + place.x));
  }
}

void paste(const render::Picture& panel, const PanelPlace& place, render::Picture& whole) {
  paste(panel.rgb, place, 3, whole.width, whole.rgb);
  if (!panel.alpha.empty()) paste(panel.alpha, place, 1, whole.width, whole.alpha);
}

render::PixelRegion region_of(const PanelPlace& p) { return {p.x, p.y, p.x + p.width, p.y + p.height}; }

/// What a region of the whole picture has of a panel, from the panel's corner on; of no width or height where
/// it has nothing.
render::PixelRegion part_of(const PanelPlace& p, const render::PixelRegion& region) {
  const auto in = [](int at, int begin, int side) { return std::clamp(at - begin, 0, side); };
  return {in(region.x0, p.x, p.width), in(region.y0, p.y, p.height), in(region.x1, p.x, p.width),
          in(region.y1, p.y, p.height)};
}

/// Of a panel's title: that of a caption of the whole picture, as far as it goes with the panel.
double title_height(const PanelPlace& panel, const render::Image& whole) {
  return std::min(overlay_text_height(whole.width(), whole.height()),
                  2.6 * overlay_unit(panel.width, panel.height));
}

bool is_empty(const render::PixelRegion& r) { return r.width() <= 0 || r.height() <= 0; }

}  // namespace

Views::View::View(SceneDesc shown, const PanelPlace& at, const sim::Model& model,
                  const std::vector<sim::Surface>& surfaces)
    : scene(std::move(shown)),
      place(at),
      fields(scene, model, surfaces),
      overlays(scene, model, surfaces),
      rig(scene, model, surfaces, at.width, at.height) {}

Views::Views(const SceneDesc& scene, const sim::Model& model, const std::vector<sim::Surface>& surfaces)
    : scene_(scene), surfaces_(surfaces) {
  const std::vector<PanelPlace> places = panel_places(scene);
  for (std::size_t i = 0; i < places.size(); ++i)
    views_.push_back(std::make_unique<View>(panel_scene(scene, i), places[i], model, surfaces));
}

bool Views::need_positions() const {
  return std::any_of(views_.begin(), views_.end(), [](const std::unique_ptr<View>& v) {
    return v->fields.is_automatic() || v->rig.needs_all_states() || v->overlays.needs_positions();
  });
}

void Views::see(int frame, const StateRecord& state, const sim::VecX& q) {
  for (const std::unique_ptr<View>& view : views_) {
    if (view->fields.is_automatic()) view->fields.see(q);
    if (view->rig.needs_all_states()) view->rig.see(q);
    view->overlays.see(frame, state, q);
  }
}

std::map<std::string, std::array<double, 2>> Views::ranges() const {
  std::map<std::string, std::array<double, 2>> all;
  for (std::size_t i = 0; i < views_.size(); ++i) {
    std::map<std::string, std::array<double, 2>> of_view = views_[i]->fields.ranges();
    of_view.merge(views_[i]->overlays.ranges());
    for (const auto& [name, range] : of_view)
      all[scene_.panel.empty() ? name : fmt::format("panel.{}/{}", i, name)] = range;
  }
  return all;
}

/// That of all frames; what is fitted to frame 0 follows from the scene.
std::optional<std::array<double, 6>> Views::fitted_box() const {
  for (const std::unique_ptr<View>& view : views_)
    if (view->rig.needs_all_states()) return view->rig.fitted_box();
  return std::nullopt;
}

std::vector<std::string> Views::findings() const {
  std::vector<std::string> lines;
  for (const auto& [body, range] : ranges())
    lines.push_back(fmt::format("{}: from {:.6g} to {:.6g}", body, range[0], range[1]));
  if (const auto box = fitted_box()) {
    lines.push_back(fmt::format("camera fitted to {:.4g} x {:.4g} x {:.4g} m", (*box)[3] - (*box)[0],
                                (*box)[4] - (*box)[1], (*box)[5] - (*box)[2]));
  }
  return lines;
}

void Views::tell(PictureRecord& record) const {
  record.ranges = ranges();
  record.fitted_box = fitted_box();
}

bool Views::drew(const PictureRecord& record) const {
  return record.ranges == ranges() && record.fitted_box == fitted_box();
}

std::vector<std::string> Views::remarks() const {
  // What has no effect in one panel may have some in another.
  std::vector<std::string> all = views_.front()->overlays.remarks();
  for (const std::unique_ptr<View>& view : views_) {
    const std::vector<std::string> own = view->overlays.remarks();
    std::erase_if(all,
                  [&](const std::string& r) { return std::find(own.begin(), own.end(), r) == own.end(); });
  }
  return all;
}

/// Panels share the renderer's meshes: each gives them its own colours.
void Views::color(render::Renderer& renderer, const View& view, const sim::VecX& q) const {
  view.fields.color_meshes(renderer, q);
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    if (!view.scene.body[i].shown.is_none() || !shows_field(scene_, i)) continue;
    renderer.update_colors(static_cast<int>(i), plain_colors(scene_, surfaces_[i], i));
  }
}

/// Panels keep the same part free, so that what has no colour bar compares.
double Views::bar_strip() const {
  double strip = 0.0;
  for (const std::unique_ptr<View>& v : views_)
    strip =
        std::max(strip, color_bar_strip(v->place.width, v->place.height, bars_of(v->fields, v->overlays)));
  return strip;
}

render::Camera Views::camera(const View& view, double frame, const sim::VecX& q) const {
  return view.rig.at(frame, q, view.rig.is_fitted() ? bar_strip() : 0.0);
}

/// While the shutter is open, the frame's last; none where the camera stands still. Its own moves are those
/// of the time between frames, and what it follows goes as the bodies do.
std::vector<render::Camera> Views::shutter_cameras(const View& view, int frame, const sim::VecX& q,
                                                   const Motion& motion) const {
  const double strip = view.rig.is_fitted() ? bar_strip() : 0.0;
  const render::CameraSettings last = view.rig.settings(frame, q, strip);
  std::vector<render::Camera> cameras;
  bool moves = false;
  for (std::size_t i = 0; i < motion.open.size(); ++i) {
    const double when = frame - frames_to_go(static_cast<int>(i), motion.shutter);
    const render::CameraSettings settings = view.rig.settings(when, motion.open[i], strip);
    moves = moves || settings != last;
    cameras.emplace_back(settings, view.place.width, view.place.height);
  }
  if (!moves) return {};
  cameras.emplace_back(last, view.place.width, view.place.height);
  return cameras;
}

render::Image Views::draw(render::Renderer& renderer, render::FrameInfo frame, const View& view,
                          const sim::VecX& q, const Motion* motion) const {
  std::optional<render::Camera> camera_before;
  std::vector<render::Camera> open;
  if (motion != nullptr && frame.frame > 0) {
    camera_before = camera(view, frame.frame - 1, motion->before);
    frame.camera_before = &*camera_before;
    open = shutter_cameras(view, frame.frame, q, *motion);
    frame.shutter_cameras = open;
  }
  frame.leaves_out_ground = !view.scene.ground.enabled;
  if (!scene_.render.region.empty()) frame.region = part_of(view.place, scene_.render.drawn());
  return renderer.render(camera(view, frame.frame, q), frame);
}

render::Image Views::draw(render::Renderer& renderer, render::FrameInfo frame, const sim::VecX& q,
                          const Motion* motion) const {
  if (scene_.panel.empty()) {
    color(renderer, *views_.front(), q);
    return draw(renderer, frame, *views_.front(), q, motion);
  }
  render::Image whole(scene_.render.width, scene_.render.height);
  for (const std::unique_ptr<View>& view : views_) {
    // The first gives the picture its channels in any case.
    if (view != views_.front() && is_empty(part_of(view->place, scene_.render.drawn()))) continue;
    color(renderer, *view, q);
    paste(draw(renderer, frame, *view, q, motion), view->place, whole);
  }
  return whole;
}

render::Picture Views::finish(const render::Image& image, const sim::State& state,
                              const StateRecord& told) const {
  const auto finished = [&](const View& view, const render::Image& drawn, OverlayLayout layout) {
    return finish_picture({drawn, camera(view, state.frame, state.q), state, told}, view.scene, view.fields,
                          view.overlays, std::move(layout));
  };
  if (scene_.panel.empty()) {
    const OverlayLayout layout(image.width(), image.height());
    return cropped(finished(*views_.front(), image, layout), scene_.render.drawn());
  }
  render::Picture whole{image.width(), image.height(), {}};
  const std::size_t pixels = static_cast<std::size_t>(whole.width) * static_cast<std::size_t>(whole.height);
  whole.rgb.resize(3 * pixels);
  if (scene_.render.transparent) whole.alpha.resize(pixels);
  const SceneCaption caption(scene_, state.frame, told);
  for (const std::unique_ptr<View>& view : views_) {
    const PanelPlace& place = view->place;
    if (is_empty(part_of(place, scene_.render.drawn()))) continue;
    OverlayLayout layout(place.width, place.height);
    layout.set_caption_height(std::max(layout.text_height(), title_height(place, image)));
    if (const std::optional<Rectangle> p = caption.plate())
      layout.occupy({p->left - place.x, p->top - place.y, p->right - place.x, p->bottom - place.y});
    paste(finished(*view, cropped(image, region_of(place)), std::move(layout)), place, whole);
  }
  caption.draw(whole);
  return cropped(std::move(whole), scene_.render.drawn());
}

bool need_all_states(const SceneDesc& scene) {
  const std::vector<SceneDesc> scenes = scenes_of(scene);
  return std::any_of(scenes.begin(), scenes.end(),
                     [](const SceneDesc& s) { return needs_sequence(s) || s.camera.frame == "motion"; });
}

}  // namespace lagomorph::apps
