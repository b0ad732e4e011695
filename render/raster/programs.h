#pragma once

#include <optional>
#include <string>

#include "render/raster/gl_objects.h"
#include "render/render_scene.h"

namespace lagomorph::render::raster {

/// What of a scene's light the shaders are made for.
struct LightFeatures {
  bool sky_map = false;      // the sky is a map
  bool sun_discs = false;    // suns are seen in the sky
  bool see_through = false;  // some bodies are not opaque; the shaders of light need not know
  bool sheen = false;        // some meshes have it
  int ground_texture = 0;    // its number in ground_texture_names()
  bool operator==(const LightFeatures&) const = default;

  /// For all shaders that know of the sky or the ground's colour. Preprocessor's, not uniforms: the software
  /// rasterizer goes through both sides of every branch.
  std::string definitions() const;
};
/// `drawn`: with_stand_ins() of the scene.
LightFeatures light_features(const RenderScene&, const RenderScene& drawn);

/// What draws the samples that say what is seen, and what lights them; `colors`: where meshes have colours of
/// their vertices.
struct SeenPrograms {
  SeenPrograms(int multisample, bool colors, const LightFeatures&);

  Program mesh, light, layer;
  std::optional<Program> plain;  // of pixels that need no more; without colours
};

/// What draws the surfaces that are not opaque, the next one of each sample at a time, lights them, and lays
/// them over the picture.
struct PeelPrograms {
  PeelPrograms(int multisample, bool colors, const LightFeatures&);

  Program mesh, surface, layer, composite;
};

/// For shaders of meshes whose vertices have colours.
const char* color_definition(bool colors);

/// What hides samples under the ground, and what says which surfaces of the others are to be lit.
struct BodyPrograms {
  explicit BodyPrograms(int multisample);

  Program ground_cover, surface;
};

/// Depths along the view axis.
struct DepthPrograms {
  DepthPrograms();

  Program mesh, ground;
};

}  // namespace lagomorph::render::raster
