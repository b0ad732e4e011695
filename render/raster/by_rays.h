#pragma once

#include <vector>

#include "render/render_scene.h"
#include "render/settings.h"

/// What of a scene the rasterizer draws by rays.
namespace lagomorph::render::raster {

/// Of a mesh.
struct ByRays {
  bool behind = false;    // what is seen through its clear inside, where it has no colours of its vertices
  bool mirrored = false;  // what its coat or, without one, its surface mirrors where that is so smooth that
                          // few rays show it without noise
  bool any() const { return behind || mirrored; }
};

struct DrawnByRays {
  std::vector<ByRays> meshes;
  bool ground = false;  // the meshes that it mirrors
  bool any() const;
};
/// Nothing where `raster.rays` is off; of meshes nothing where one of the scene is see-through.
DrawnByRays drawn_by_rays(const RenderScene&, const RasterSettings&);

/// Whether its coat or, without one, its surface is smooth enough.
bool is_smooth_mirror(const Material&);
/// Part of the light that comes through a mesh with a clear inside whose mean thickness is `thickness` [m].
float light_through(const Material&, float thickness);
/// Part of the light that a mesh stops; `clear`: what is behind it is drawn by rays.
float opacity_to_light(const Mesh&, bool clear);

/// How rough surfaces are to rays; from some roughness on, a pixel takes more rays.
constexpr float smooth_alpha = 2e-3F;  // up to which they are drawn as if they were smooth
constexpr float rough_alpha = 1e-2F;
float alpha_for_rays(const Material&);

}  // namespace lagomorph::render::raster
