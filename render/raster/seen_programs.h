#pragma once

#include "render/raster/gl_objects.h"

namespace lagomorph::render::raster {

/// What draws the samples that say what is seen, and what lights them; `colors`: where meshes have colours of
/// their vertices.
struct SeenPrograms {
  SeenPrograms(int multisample, bool colors);

  Program mesh, light, layer;
};

}  // namespace lagomorph::render::raster
