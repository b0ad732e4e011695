#include "apps/scene/panels.h"

#include <algorithm>
#include <cmath>

namespace lagomorph::apps {
namespace {

int column_count(const SceneDesc& scene) {
  const int panels = static_cast<int>(scene.panel.size());
  if (scene.layout.columns > 0) return std::min(scene.layout.columns, panels);
  if (panels <= 3) return panels;
  return static_cast<int>(std::ceil(std::sqrt(panels)));
}

/// Where cell i of n begins on a side, gaps between them.
int begin_of(int i, int n, int side, int gap) { return i * (side - gap * (n - 1)) / n + i * gap; }

/// A quantity that a panel gives stands still: it has no keys there.
template <class T, class Value>
void override_by(CameraDesc& camera, const std::optional<T>& given, std::optional<T> CameraKey::*keyed,
                 const Value& take) {
  if (!given) return;
  take(*given);
  for (CameraKey& key : camera.key) (key.*keyed).reset();
}

void override_camera(CameraDesc& c, const PanelDesc& p) {
  override_by(c, p.position, &CameraKey::position, [&](const sim::Vec3& v) { c.position = v.cast<float>(); });
  override_by(c, p.look_at, &CameraKey::look_at, [&](const sim::Vec3& v) { c.look_at = v.cast<float>(); });
  override_by(c, p.up, &CameraKey::up, [&](const sim::Vec3& v) { c.up = v.cast<float>(); });
  override_by(c, p.fov, &CameraKey::fov, [&](float v) { c.fov = v; });
  override_by(c, p.orthographic, &CameraKey::orthographic, [&](float v) { c.orthographic = v; });
  override_by(c, p.zoom, &CameraKey::zoom, [&](float v) { c.zoom = v; });
  if (p.view != "same") c.view = p.view;
  if (p.frame != "same") c.frame = p.frame;
  if (p.view == "same" && p.position) c.view = "none";
}

void override_field(ShownField& shown, const PanelDesc& p) {
  if (p.field != "same") {
    shown.field = p.field;
    shown.colormap = "auto";
    shown.range.reset();
  }
  if (p.colormap != "same") shown.colormap = p.colormap;
  if (p.range) shown.range = p.range;
}

}  // namespace

std::vector<PanelPlace> panel_places(const SceneDesc& scene) {
  const int width = scene.render.width, height = scene.render.height, gap = scene.layout.gap;
  if (scene.panel.empty()) return {{0, 0, width, height}};
  const int count = static_cast<int>(scene.panel.size()), columns = column_count(scene);
  const int rows = (count + columns - 1) / columns;
  std::vector<PanelPlace> places;
  for (int i = 0; i < count; ++i) {
    const int column = i % columns, row = i / columns;
    PanelPlace place;
    place.x = begin_of(column, columns, width, gap);
    place.y = begin_of(row, rows, height, gap);
    place.width = begin_of(column + 1, columns, width, gap) - gap - place.x;
    place.height = begin_of(row + 1, rows, height, gap) - gap - place.y;
    places.push_back(place);
  }
  return places;
}

SceneDesc panel_scene(const SceneDesc& scene, std::size_t panel) {
  SceneDesc shown = scene;
  if (scene.panel.empty()) return shown;
  const PanelPlace place = panel_places(scene)[panel];
  override_camera(shown.camera, scene.panel[panel]);
  if (shown.camera.view == "bottom") shown.ground.enabled = false;
  for (BodyDesc& body : shown.body) override_field(body.shown, scene.panel[panel]);
  shown.panel.clear();
  shown.caption.text = scene.panel[panel].title;
  shown.caption.place = "top";
  shown.energy_plot.show = shown.energy_plot.show && panel == 0;  // one is enough
  shown.render.width = place.width;
  shown.render.height = place.height;
  shown.render.region.clear();  // is of the whole
  return shown;
}

bool shows_field(const SceneDesc& scene, std::size_t body) {
  const bool own = !scene.body[body].shown.is_none();
  if (scene.panel.empty()) return own;
  return std::any_of(scene.panel.begin(), scene.panel.end(),
                     [&](const PanelDesc& p) { return p.field == "same" ? own : p.field != "none"; });
}

}  // namespace lagomorph::apps
