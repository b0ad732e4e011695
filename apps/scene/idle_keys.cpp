#include "apps/scene/idle_keys.h"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include "apps/scene/panels.h"
#include "apps/scene/scene.h"

namespace lagomorph::apps {
namespace {

struct IdleRow {
  std::vector<std::string> keys;  // or where their names begin, with a dot at the end
  bool (*is_idle)(const SceneDesc&);
  std::string reason;
};

bool fits_a_box(const SceneDesc& scene) {
  for (std::size_t i = 0; i < panel_places(scene).size(); ++i) {
    const std::string frame = panel_scene(scene, i).camera.frame;
    if (frame == "rest" || frame == "motion") return true;
  }
  return false;
}

bool has_lens(const SceneDesc& scene) {
  const std::vector<CameraKey>& keys = scene.camera.key;
  return scene.camera.f_stop > 0.0F || std::any_of(keys.begin(), keys.end(), [](const CameraKey& k) {
           return k.f_stop.value_or(0.0F) > 0.0F;
         });
}

/// Whether no view of the scene has a perspective.
bool is_orthographic(const SceneDesc& scene) {
  for (std::size_t i = 0; i < panel_places(scene).size(); ++i)
    if (!panel_scene(scene, i).camera.orthographic) return false;
  return true;
}

const std::vector<IdleRow>& idle_rows() {
  static const std::vector<IdleRow> rows = {
      {{"render.samples", "render.path."},
       [](const SceneDesc& s) { return s.render.backend == "raster"; },
       "render.backend = \"raster\""},
      {{"render.raster."},
       [](const SceneDesc& s) { return s.render.backend == "path"; },
       "render.backend = \"path\""},
      {{"render.path.min_samples"},
       [](const SceneDesc& s) { return s.render.backend == "path" && s.render.path.noise_threshold == 0.0F; },
       "render.path.noise_threshold is 0"},
      {{"camera.interpolation"},
       [](const SceneDesc& s) { return s.camera.key.empty(); },
       "there is no [[camera.key]]"},
      {{"camera.margin"},
       [](const SceneDesc& s) { return !fits_a_box(s); },
       "camera.frame is neither \"rest\" nor \"motion\""},
      {{"camera.focus_distance", "camera.sensor_height", "camera.blades", "camera.blade_rotation"},
       [](const SceneDesc& s) { return !has_lens(s); },
       "camera.f_stop is 0"},
      {{"camera.f_stop", "camera.focus_distance", "camera.sensor_height", "camera.blades",
        "camera.blade_rotation"},
       [](const SceneDesc& s) { return has_lens(s) && is_orthographic(s); },
       "camera.orthographic is given"},
      {{"glyphs.pins", "glyphs.pin_color"},
       [](const SceneDesc& s) {
         return std::all_of(s.body.begin(), s.body.end(),
                            [](const BodyDesc& b) { return b.physics.pin.empty(); });
       },
       "no body has a pin"},
      {{"energy_plot."}, [](const SceneDesc& s) { return !s.energy_plot.show; }, "energy_plot.show is false"},
      {{"ground.shadow_catcher"},
       [](const SceneDesc& s) { return !s.render.transparent; },
       "render.transparent is false"},
      {{"ground.shadow_catcher"},
       [](const SceneDesc& s) { return s.render.transparent && !s.ground.enabled; },
       "ground.enabled is false"},
      {{"layout."}, [](const SceneDesc& s) { return s.panel.empty(); }, "there is no [[panel]]"},
  };
  return rows;
}

/// Of keys of a camera that all draw sharp.
IdleRow of_no_lens(std::size_t key_count) {
  IdleRow row{{}, nullptr, "camera.f_stop is 0"};
  for (std::size_t i = 0; i < key_count; ++i)
    row.keys.push_back(fmt::format("camera.key.{}.focus_distance", i));
  return row;
}

/// Of a body whose surface has its own colour.
IdleRow of_no_field(std::size_t body) {
  const std::string look = fmt::format("body.{}.look.", body);
  return {{look + "range", look + "colormap", look + "color_bar"}, nullptr, look + "field is \"none\""};
}

bool is_of(const std::string& key, const IdleRow& row) {
  return std::any_of(row.keys.begin(), row.keys.end(), [&](const std::string& name) {
    return name.ends_with('.') ? key.starts_with(name) : key == name;
  });
}

}  // namespace

std::vector<std::string> idle_keys(const SceneDesc& scene) {
  const std::vector<ResolvedKey> given = picture_keys(scene);
  std::vector<std::string> lines;
  const auto tell = [&](const IdleRow& row) {
    std::string names;
    int count = 0;
    for (const ResolvedKey& key : given) {
      if (!is_of(key.key, row)) continue;
      names += (count++ == 0 ? "" : ", ") + key.key;
    }
    if (count > 0)
      lines.push_back(fmt::format("{} {} no effect: {}", names, count == 1 ? "has" : "have", row.reason));
  };
  for (const IdleRow& row : idle_rows())
    if (row.is_idle(scene)) tell(row);
  if (!has_lens(scene)) tell(of_no_lens(scene.camera.key.size()));
  for (std::size_t i = 0; i < scene.body.size(); ++i)
    if (!shows_field(scene, i)) tell(of_no_field(i));
  return lines;
}

}  // namespace lagomorph::apps
