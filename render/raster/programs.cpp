#include "render/raster/programs.h"

#include <string>

#include "render/raster/shaders/shaders.h"

namespace lagomorph::render::raster {
namespace {

std::string definitions(int multisample, bool colors) {
  return "#define SAMPLES " + std::to_string(multisample) + "\n" + (colors ? "#define COLORS\n" : "");
}

}  // namespace

const char* color_definition(bool colors) { return colors ? "#define COLORS\n" : ""; }

SeenPrograms::SeenPrograms(int multisample, bool colors)
    : mesh("seen mesh", {color_definition(colors), shaders::frame, shaders::mesh_vertex},
           {color_definition(colors), shaders::frame, shaders::seen_fragment}),
      light("seen light", {shaders::frame, shaders::emitter_vertex},
            {"#define EMITTER\n", color_definition(colors), shaders::frame, shaders::seen_fragment}),
      layer("layer", {shaders::frame, shaders::layer_vertex},
            {"#define SHADOWS\n", definitions(multisample, colors).c_str(), shaders::frame, shaders::brdf,
             shaders::shadow, shaders::sky, shaders::shade, shaders::ground_point, shaders::layers,
             shaders::layer_fragment}) {}

Programs::Programs(int multisample)
    : seen(multisample, false),
      ground_cover("ground cover", {shaders::frame, shaders::ground_vertex},
                   {shaders::frame, shaders::ground_point, shaders::ground_cover_fragment}),
      background("background", {shaders::full_screen_vertex},
                 {shaders::frame, shaders::sky, shaders::background_fragment}),
      ground("ground", {shaders::frame, shaders::ground_vertex},
             {shaders::frame, shaders::brdf, shaders::sky, shaders::shade, shaders::ground_point,
              shaders::ground_color, shaders::ground_fragment}),
      shadowed_ground(
          "shadowed ground", {shaders::frame, shaders::ground_vertex},
          {"#define SHADOWS\n", shaders::frame, shaders::brdf, shaders::shadow, shaders::sky, shaders::shade,
           shaders::ground_point, shaders::ground_color, shaders::ground_fragment}),
      count("count of layers", {shaders::full_screen_vertex},
            {definitions(multisample, false).c_str(), shaders::frame, shaders::layers,
             shaders::count_fragment}),
      mesh_depth("mesh depth", {shaders::frame, shaders::mesh_vertex},
                 {shaders::frame, shaders::mesh_depth_fragment}),
      ground_depth("ground depth", {shaders::frame, shaders::ground_vertex},
                   {shaders::frame, shaders::ground_point, shaders::ground_depth_fragment}) {}

}  // namespace lagomorph::render::raster
