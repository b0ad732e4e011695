#pragma once

#include <optional>
#include <vector>

#include "render/path/bsdf.h"
#include "render/path/light.h"
#include "render/path/light_formulas.h"
#include "render/path/sky_sampler.h"
#include "render/path/sun.h"
#include "render/render_scene.h"

namespace lagomorph::render::path {

/// What paths need to know of a scene besides its geometry.
struct Shading {
  explicit Shading(const RenderScene&);

  std::vector<Bsdf> brdfs;       // a mesh each, then the ground's
  std::vector<Color> albedos;    // likewise
  std::vector<float> opacities;  // of the meshes
  bool see_through = false;      // some are not opaque
  std::vector<RectangleLight> lights;
  std::vector<float> pick;  // probability of each light where one is picked
  std::vector<SunLight> suns;
  std::vector<float> sun_pick;  // likewise
  Ground ground;
  Sky sky;
  std::optional<SkySampler> sky_sampler;  // of a sky with a map
  std::optional<Color> background;

  /// The sky's light, of one without a map.
  SkyGradient gradient() const {
    return {f3(Color(sky.strength * sky.horizon)), f3(Color(sky.strength * sky.zenith))};
  }
  /// What the camera sees along a direction that meets nothing.
  Color open_view(const Vec3& direction) const;

  const Bsdf& ground_brdf() const { return brdfs.back(); }
  /// The ground's colour at a point of it, where it has a texture.
  std::optional<Color> textured_ground(const Vec3& point) const;

private:
  bool has_texture_;  // of the ground
};

}  // namespace lagomorph::render::path
