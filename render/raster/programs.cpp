#include "render/raster/programs.h"

#include <algorithm>
#include <string>
#include <vector>

#include "render/ground_texture.h"
#include "render/raster/ray_scene.h"
#include "render/raster/shaders/shaders.h"

namespace lagomorph::render::raster {
namespace {

std::string definitions(int multisample, bool colors) {
  return "#define SAMPLES " + std::to_string(multisample) + "\n" + (colors ? "#define COLORS\n" : "");
}

}  // namespace

const char* color_definition(bool colors) { return colors ? "#define COLORS\n" : ""; }

std::string LightFeatures::definitions() const {
  return std::string(sky_map ? "#define SKY_MAP\n" : "") + (sun_discs ? "#define SUN_DISCS\n" : "") +
         (sheen ? "#define SHEEN\n" : "") + "#define SMALL_SUN " + std::to_string(small_sun) +
         "\n#define GROUND_TEXTURE " + std::to_string(ground_texture) + "\n";
}

LightFeatures light_features(const RenderScene& scene, const RenderScene& drawn) {
  const auto any_material = [&](const auto& holds) {
    return std::any_of(scene.meshes.begin(), scene.meshes.end(),
                       [&](const Mesh& mesh) { return holds(mesh.material); });
  };
  const std::vector<std::string> textures = ground_texture_names();
  const auto texture = std::find(textures.begin(), textures.end(), drawn.ground.texture) - textures.begin();
  return {.sky_map = drawn.sky.map != nullptr,
          .sun_discs = !drawn.background && std::any_of(drawn.suns.begin(), drawn.suns.end(),
                                                        [](const Sun& sun) { return sun.visible; }),
          .see_through = any_material([](const Material& m) { return m.opacity < 1.0F; }),
          .sheen = any_material([](const Material& m) { return m.sheen > 0.0F; }),
          .ground_texture = static_cast<int>(texture)};
}

SeenPrograms::SeenPrograms(int multisample, bool colors, const LightFeatures& light_features)
    : mesh("seen mesh", {color_definition(colors), shaders::frame, shaders::mesh_vertex},
           {color_definition(colors), shaders::frame, shaders::seen_fragment}),
      light("seen light", {shaders::frame, shaders::emitter_vertex},
            {"#define EMITTER\n", color_definition(colors), shaders::frame, shaders::seen_fragment}),
      layer("layer", {shaders::frame, shaders::layer_vertex},
            {light_features.definitions().c_str(), definitions(multisample, colors).c_str(), shaders::frame,
             shaders::brdf, shaders::sky, shaders::shade, shaders::ground_point, shaders::octahedron,
             shaders::layers, shaders::layer_point, shaders::parts_seen, shaders::layer_fragment}) {
  if (colors) return;
  plain.emplace("plain", Program::Parts{shaders::plain_vertex},
                Program::Parts{light_features.definitions().c_str(), definitions(multisample, false).c_str(),
                               shaders::frame, shaders::brdf, shaders::sky, shaders::shade,
                               shaders::octahedron, shaders::parts_seen, shaders::plain_fragment});
}

PeelPrograms::PeelPrograms(int multisample, bool colors, const LightFeatures& light_features)
    : mesh("peeled mesh", {"#define PEEL\n", color_definition(colors), shaders::frame, shaders::mesh_vertex},
           {"#define PEEL\n", definitions(multisample, colors).c_str(), shaders::frame,
            shaders::seen_fragment}),
      surface("peeled surface", {shaders::full_screen_vertex},
              {"#define PEEL\n", definitions(multisample, false).c_str(), shaders::frame, shaders::octahedron,
               shaders::layers, shaders::layer_point, shaders::surface_fragment}),
      layer("peeled layer", {shaders::frame, shaders::layer_vertex},
            {"#define PEEL\n", light_features.definitions().c_str(), definitions(multisample, colors).c_str(),
             shaders::frame, shaders::brdf, shaders::sky, shaders::shade, shaders::ground_point,
             shaders::octahedron, shaders::layers, shaders::layer_point, shaders::parts_seen,
             shaders::layer_fragment}),
      composite("peeled surfaces over the picture", {shaders::full_screen_vertex},
                {shaders::composite_fragment}) {}

BodyPrograms::BodyPrograms(int multisample)
    : ground_cover("ground cover", {shaders::frame, shaders::ground_vertex},
                   {shaders::frame, shaders::ground_point, shaders::ground_cover_fragment}),
      surface("surface", {shaders::full_screen_vertex},
              {definitions(multisample, false).c_str(), shaders::frame, shaders::octahedron, shaders::layers,
               shaders::layer_point, shaders::surface_fragment}) {}

DepthPrograms::DepthPrograms()
    : mesh("mesh depth", {shaders::frame, shaders::mesh_vertex},
           {shaders::frame, shaders::mesh_depth_fragment}),
      ground("ground depth", {shaders::frame, shaders::ground_vertex},
             {shaders::frame, shaders::ground_point, shaders::ground_depth_fragment}) {}

}  // namespace lagomorph::render::raster
