#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/overlay/caption.h"
#include "apps/scene/camera_moves.h"
#include "apps/scene/panels.h"
#include "apps/scene/read.h"
#include "apps/scene/shutter.h"
#include "render/channels.h"

/// What keys of the camera, its moves, panels and region must hold together.
namespace lagomorph::apps {
namespace {

/// Where what is wrong with some keys stands: an override's place, where one of them is given by one, or the
/// first that is given.
std::string place_of_any(const std::vector<std::string>& keys, const Places& places) {
  for (const std::string& key : keys)
    if (places.overridden(key)) return places.of(key);
  for (const std::string& key : keys)
    if (places.has(key)) return places.of(key);
  return places.of(keys.back());
}

/// Keys by which a frame's camera has one of these quantities, the nearest first.
std::vector<std::string> keys_of_camera(const CameraDesc& c, const std::string& name,
                                        const std::vector<const char*>& quantities) {
  std::vector<std::string> keys;
  for (const char* const quantity : quantities)
    if (name != "camera") keys.push_back(fmt::format("{}.{}", name, quantity));
  for (std::size_t i = 0; i < c.key.size(); ++i)
    for (const char* const quantity : quantities)
      keys.push_back(fmt::format("camera.key.{}.{}", i, quantity));
  for (const char* const quantity : quantities) keys.push_back(fmt::format("camera.{}", quantity));
  return keys;
}

/// `name` is "camera" in messages, `when` "in frame 3 " where there are many.
void check_frame(const CameraDesc& camera, const render::CameraSettings& c, const std::string& when,
                 const std::string& name, const Places& places) {
  // In double precision, where the squares of large floats do not overflow.
  const Eigen::Vector3d view = c.look_at.cast<double>() - c.position.cast<double>();
  const Eigen::Vector3d up = c.up.cast<double>();
  if (view.norm() == 0.0) {
    wrong_input(fmt::format("{}{}{}.position and {}.look_at are the same point",
                            place_of_any(keys_of_camera(camera, name, {"look_at", "position"}), places), when,
                            name, name));
  }
  // Below some ten units in the last place of a float the picture's axes are noise.
  if (up.normalized().cross(view.normalized()).norm() < 1e-6) {
    const char* fault = up.norm() == 0.0 ? "must not be 0" : "must not be along the view";
    wrong_input(
        fmt::format("{}{}{}.up {}",
                    place_of_any(keys_of_camera(camera, name, {"up", "look_at", "position", "view"}), places),
                    when, name, fault));
  }
}

void check_key(const CameraDesc& c, std::size_t i, double fps, const Places& places) {
  const CameraKey& key = c.key[i];
  const std::string path = fmt::format("camera.key.{}", i);
  const auto refuse = [&](const std::string& what) {
    wrong_input(fmt::format("{}{} {}", places.of(path), path, what));
  };
  if (key.time.has_value() == key.frame.has_value()) refuse("needs a time or a frame, one of them");
  const auto time = [&](const CameraKey& k) { return k.time ? *k.time : *k.frame / fps; };
  if (i > 0 && time(key) <= time(c.key[i - 1])) {
    refuse(fmt::format("is at {:.6g} s and must be later than camera.key.{}, at {:.6g} s", time(key), i - 1,
                       time(c.key[i - 1])));
  }
  if (!key.position && !key.look_at && !key.up && !key.fov && !key.orthographic && !key.zoom &&
      !key.focus_distance && !key.f_stop)
    refuse("says nothing; give position, look_at, up, fov, orthographic, zoom, focus_distance or f_stop");
  if (key.orthographic && !c.orthographic)
    refuse("has an orthographic height, but camera.orthographic is not given");
  if (key.fov && c.orthographic) refuse("has a fov, but the camera is orthographic");
  if ((key.position || key.up) && c.view != "none")
    refuse("has a position or up, but camera.view says from where it looks");
}

void check_moves(const SceneDesc& scene, const std::string& name, const Places& places) {
  constexpr int most = 10000;  // of longer sequences the later frames are checked as they are drawn
  const CameraDesc& c = scene.camera;
  const CameraMoves moves(c, scene.time, static_cast<double>(scene.render.width) / scene.render.height);
  const int last = c.key.empty() ? 0 : std::min(scene.time.frames, most) - 1;
  const auto check_at = [&](double when, const std::string& told) {
    check_frame(c, moves.at(when, std::nullopt), told, name, places);
  };
  for (int frame = 0; frame <= last; ++frame) {
    check_at(frame, c.key.empty() ? "" : fmt::format("in frame {} ", frame));
    for (int step = 0; c.shutter > 0.0F && frame > 0 && step < motion_segments; ++step) {
      check_at(frame - frames_to_go(step, static_cast<double>(c.shutter)),
               fmt::format("while the shutter of frame {} is open ", frame));
    }
  }
}

void check_panel(const SceneDesc& scene, std::size_t i, const Places& places) {
  const std::string path = fmt::format("panel.{}", i);
  const PanelDesc& panel = scene.panel[i];
  const PanelPlace place = panel_places(scene)[i];
  constexpr int least = 16;  // [pixels]
  if (place.width < least || place.height < least) {
    wrong_input(fmt::format("{}{}: the picture of {} x {} leaves it {} x {} pixels; at least {} are needed",
                            places.of(path), path, scene.render.width, scene.render.height, place.width,
                            place.height, least));
  }
  const SceneDesc shown = panel_scene(scene, i);
  check_moves(shown, path, places);
  const bool has_field =
      std::any_of(shown.body.begin(), shown.body.end(), [](const BodyDesc& b) { return !b.shown.is_none(); });
  if (!has_field && (panel.range || panel.colormap != "same")) {
    wrong_input(fmt::format("{}{} has a range or colormap, but shows no field", places.of(path), path));
  }
  if (panel.range && !((*panel.range)[0] < (*panel.range)[1])) {
    wrong_input(fmt::format("{}{}.range = [{}, {}]: the first must be less than the second",
                            places.of(path + ".range"), path, (*panel.range)[0], (*panel.range)[1]));
  }
  try {
    caption_text(panel.title, {});
  } catch (const Error& e) {
    wrong_input(fmt::format("{}{}.title: {}", places.of(path + ".title"), path, e.what()));
  }
}

void check_region(const render::RenderSettings& r, const Places& places) {
  if (r.region.empty()) return;
  const std::string at = places.of("render.region");
  if (r.region.size() != 4) wrong_input(fmt::format("{}render.region must be [x0, y0, x1, y1]", at));
  const render::PixelRegion d = r.drawn();
  if (d.x0 >= d.x1 || d.y0 >= d.y1 || d.x1 > r.width || d.y1 > r.height) {
    wrong_input(
        fmt::format("{}render.region = [{}, {}, {}, {}] must be in the picture of {} x {} pixels, x0 "
                    "< x1 and y0 < y1",
                    at, d.x0, d.y0, d.x1, d.y1, r.width, r.height));
  }
}

/// Channels with a value for several pixels are not cut.
void check_cells(const SceneDesc& scene, const char* by, const Places& places) {
  for (const std::string& name : scene.render.channels) {
    if (render::channel_kind(name).cell == 1) continue;
    wrong_input(fmt::format("{}render.channels: '{}' is of whole pictures, not of {}",
                            places.of("render.channels"), name, by));
  }
}

}  // namespace

void check_views(const SceneDesc& scene, const Places& places) {
  const CameraDesc& c = scene.camera;
  for (std::size_t i = 0; i < c.key.size(); ++i) check_key(c, i, scene.time.fps, places);
  if (c.turntable.turns && c.turntable.period) {
    wrong_input(fmt::format("{}camera.turntable has turns and a period; give one of them",
                            places.of("camera.turntable")));
  }
  if (c.view != "none" && c.up != render::CameraSettings().up) {
    wrong_input(
        fmt::format("{}camera.up has no effect with camera.view = \"{}\"", places.of("camera.up"), c.view));
  }
  check_region(scene.render, places);
  if (!scene.render.region.empty()) check_cells(scene, "a region", places);
  if (scene.panel.empty()) return check_moves(scene, "camera", places);
  check_cells(scene, "panels", places);
  for (std::size_t i = 0; i < scene.panel.size(); ++i) check_panel(scene, i, places);
}

}  // namespace lagomorph::apps
