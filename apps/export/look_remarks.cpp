#include "apps/export/look_remarks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/export/moving_mesh.h"

namespace lagomorph::apps {
namespace {

/// `lost` gives what the format has not, beyond what none has.
template <class Lost>
std::vector<std::string> remarks(const ExportedScene& scene, const char* format, Lost lost) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    const BodyDesc& body = scene.desc.body[i];
    std::vector<std::string> what = lost(body.look);
    if (has_cloudy_inside(body.look)) what.emplace_back("subsurface (an opaque base of subsurface_color)");
    const bool colors = !body.shown.is_none() && scene.colors.empty();
    if (colors) what.push_back("the colours of " + body.shown.field);
    if (!what.empty())
      lines.push_back(fmt::format("{}: {} of body '{}' {} left out", format, fmt::join(what, ", "),
                                  scene.model.mesh().bodies[i].name,
                                  what.size() == 1 && !colors ? "is" : "are"));
  }
  return lines;
}

/// Of formats that know nothing clear inside.
std::vector<std::string> opaque_inside(const render::Material& look) {
  if (!has_clear_inside(look)) return {};
  return {"transmission (an opaque base of absorption_color)"};
}

}  // namespace

std::vector<std::string> gltf_remarks(const ExportedScene& scene) {
  std::vector<std::string> lines =
      remarks(scene, "gltf", [](const render::Material&) { return std::vector<std::string>(); });
  for (std::size_t i = 0; i < scene.colors.size(); ++i) {
    if (scene.colors[i].empty()) continue;
    lines.push_back(
        fmt::format("gltf: body '{}' keeps the colours of {} of frame {} throughout; glTF has none that move",
                    scene.model.mesh().bodies[i].name, scene.desc.body[i].shown.field, scene.color_frame));
  }
  return lines;
}

std::vector<std::string> obj_remarks(const ExportedScene& scene) {
  return remarks(scene, "obj", opaque_inside);
}

std::vector<std::string> usd_remarks(const ExportedScene& scene) {
  return remarks(scene, "usda", [](const render::Material& look) {
    std::vector<std::string> what = opaque_inside(look);
    if (look.sheen > 0.0F) what.emplace_back("sheen");
    return what;
  });
}

}  // namespace lagomorph::apps
