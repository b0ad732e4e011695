#include "apps/export/gltf_material.h"

#include <algorithm>

#include "render/albedo.h"

namespace lagomorph::apps {
namespace {

using Json = nlohmann::ordered_json;

Json factors_of(const render::Color& c) { return {c.x(), c.y(), c.z()}; }

/// glTF tints what goes through the surface by the base colour, here it is clear: white as much as it is.
render::Color base_color(render::Material look) {
  look.absorption_color = render::Color::Ones();
  return render::albedo(look);
}

}  // namespace

Json gltf_material(const MovingMesh& mesh, const Extent& extent) {
  const render::Material& look = mesh.look();
  const render::Color base = base_color(look);
  Json material = {{"name", mesh.name()},
                   {"pbrMetallicRoughness",
                    {{"baseColorFactor", {base.x(), base.y(), base.z(), look.opacity}},
                     {"metallicFactor", look.metallic},
                     {"roughnessFactor", look.roughness}}}};
  if (look.opacity < 1.0F) material["alphaMode"] = "BLEND";
  if (!has_clear_inside(look)) material["doubleSided"] = true;  // a volume has two sides as it is
  const auto extend = [&](const char* name, Json members) {
    material["extensions"][name] = std::move(members);
  };
  if (look.ior != 1.5F) extend("KHR_materials_ior", {{"ior", look.ior}});
  if (has_clear_inside(look)) {
    extend("KHR_materials_transmission", {{"transmissionFactor", look.transmission}});
    Json volume = {{"thicknessFactor", (extent.max - extent.min).minCoeff()}};
    if ((look.absorption_color != render::Color::Ones()).any()) {
      volume["attenuationColor"] = factors_of(look.absorption_color);
      volume["attenuationDistance"] = look.absorption_distance;
    }
    extend("KHR_materials_volume", std::move(volume));
  }
  if (look.coat > 0.0F)
    extend("KHR_materials_clearcoat",
           {{"clearcoatFactor", look.coat}, {"clearcoatRoughnessFactor", look.coat_roughness}});
  if (look.sheen > 0.0F)
    extend("KHR_materials_sheen", {{"sheenColorFactor", factors_of(look.sheen * look.sheen_tint)},
                                   {"sheenRoughnessFactor", look.sheen_roughness}});
  return material;
}

std::vector<std::string> extensions_of(const Json& materials) {
  std::vector<std::string> names;
  for (const Json& material : materials) {
    if (!material.contains("extensions")) continue;
    for (const auto& [name, members] : material["extensions"].items())
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

}  // namespace lagomorph::apps
