#include "render/raster/optics_stand_in.h"

#include <algorithm>

#include "render/albedo.h"

namespace lagomorph::render::raster {

Material optics_stand_in(const Material& m) {
  Material drawn = m;
  drawn.base_color = albedo(m);
  drawn.roughness += m.coat * (std::min(m.roughness, m.coat_roughness) - m.roughness);
  return drawn;
}

std::vector<std::string> optics_remarks(const RenderScene& scene) {
  std::vector<std::string> remarks;
  for (const Mesh& mesh : scene.meshes) {
    const Material& m = mesh.material;
    std::string what;
    const auto add = [&](bool there, const char* drawn) {
      if (there) what += (what.empty() ? "" : "; ") + std::string(drawn);
    };
    add(m.transmission > 0.0F, "transmission is an opaque base of absorption_color");
    add(m.subsurface > 0.0F, "subsurface is an opaque base of subsurface_color");
    add(m.coat > 0.0F, "coat sharpens the highlights instead of adding its own");
    add(m.sheen > 0.0F, "sheen is left out");
    if (!what.empty()) remarks.push_back("look of '" + mesh.name + "': " + what);
  }
  return remarks;
}

}  // namespace lagomorph::render::raster
