#pragma once

#include "render/raster/gl_objects.h"

namespace lagomorph::render::raster {

/// What draws the samples that say what is seen, and what lights them; `colors`: where meshes have colours of
/// their vertices.
struct SeenPrograms {
  SeenPrograms(int multisample, bool colors);

  Program mesh, light, layer;
};

/// For shaders of meshes whose vertices have colours.
const char* color_definition(bool colors);

/// All but those of LightMaps, and those that few scenes need.
struct Programs {
  explicit Programs(int multisample);

  SeenPrograms seen;
  Program ground_cover, background, ground, shadowed_ground, count, mesh_depth, ground_depth;
};

}  // namespace lagomorph::render::raster
