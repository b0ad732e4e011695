#include "apps/scene/idle_keys.h"

#include <algorithm>

#include <fmt/format.h>

#include "apps/scene/panels.h"
#include "apps/scene/scene.h"

namespace lagomorph::apps {
namespace {

struct IdleRow {
  std::vector<const char*> keys;  // or where their names begin, with a dot at the end
  bool (*is_idle)(const SceneDesc&);
  const char* reason;
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
      {{"camera.focus_distance", "camera.blades", "camera.blade_rotation"},
       [](const SceneDesc& s) { return s.render.backend == "path" && !has_lens(s); },
       "camera.f_stop is 0"},
      {{"layout."}, [](const SceneDesc& s) { return s.panel.empty(); }, "there is no [[panel]]"},
  };
  return rows;
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
  for (const IdleRow& row : idle_rows()) {
    if (!row.is_idle(scene)) continue;
    std::string names;
    int count = 0;
    for (const ResolvedKey& key : given) {
      if (!is_of(key.key, row)) continue;
      names += (count++ == 0 ? "" : ", ") + key.key;
    }
    if (count > 0)
      lines.push_back(fmt::format("{} {} no effect: {}", names, count == 1 ? "has" : "have", row.reason));
  }
  return lines;
}

}  // namespace lagomorph::apps
