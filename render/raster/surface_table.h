#pragma once

#include <optional>
#include <vector>

#include "render/raster/by_rays.h"
#include "render/raster/frame_block.h"
#include "render/raster/gl_objects.h"
#include "render/render_scene.h"

namespace lagomorph::render::raster {

/// White, and mirrors nothing: its light is the irradiance over pi.
SurfaceBlock matte_ground();

/// The shaders' table of surfaces: the ground's, the meshes', the lights'.
class SurfaceTable {
public:
  /// `lights`: those that are seen; `sheen`: some mesh has it.
  void set_scene(const RenderScene&, const DrawnByRays&, const std::vector<AreaLight>& lights, bool sheen);
  const SurfaceBlock& ground() const { return ground_; }
  /// Binds it, and the table of sheens where there is one, where the shaders expect them.
  void bind() const;
  /// In place of them the ground alone, see matte_ground().
  void bind_matte_ground() const;

private:
  void set_sheens(const RenderScene&, std::vector<SurfaceBlock>&);

  SurfaceBlock ground_{};
  Buffer surfaces_, matte_ground_;
  std::optional<Texture> sheens_;
};

}  // namespace lagomorph::render::raster
