#include "render/raster/seen_programs.h"

#include <string>

#include "render/raster/shaders/shaders.h"

namespace lagomorph::render::raster {
namespace {

std::string definitions(int multisample, bool colors) {
  return "#define SAMPLES " + std::to_string(multisample) + "\n" + (colors ? "#define COLORS\n" : "");
}
const char* definition(bool colors) { return colors ? "#define COLORS\n" : ""; }

}  // namespace

SeenPrograms::SeenPrograms(int multisample, bool colors)
    : mesh("seen mesh", {definition(colors), shaders::frame, shaders::mesh_vertex},
           {definition(colors), shaders::frame, shaders::seen_fragment}),
      light("seen light", {shaders::frame, shaders::emitter_vertex},
            {"#define EMITTER\n", definition(colors), shaders::frame, shaders::seen_fragment}),
      layer("layer", {shaders::frame, shaders::layer_vertex},
            {"#define SHADOWS\n", definitions(multisample, colors).c_str(), shaders::frame, shaders::brdf,
             shaders::shadow, shaders::sky, shaders::shade, shaders::ground_point, shaders::layers,
             shaders::layer_fragment}) {}

}  // namespace lagomorph::render::raster
