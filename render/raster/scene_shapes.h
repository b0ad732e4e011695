#pragma once

#include <vector>

#include "render/raster/by_rays.h"
#include "render/raster/gl_objects.h"
#include "render/raster/mesh_buffers.h"
#include "render/render_scene.h"

namespace lagomorph::render::raster {

/// Meshes of a scene; solid ones are those that are opaque and not clear.
enum class Which { all, opaque, solid, see_through };

/// What of a scene has a shape, to be drawn by any program.
class SceneShapes {
public:
  void set_scene(const RenderScene&, const DrawnByRays&);

  std::vector<MeshBuffers>& meshes() { return meshes_; }
  const std::vector<MeshBuffers>& meshes() const { return meshes_; }
  bool any(bool (MeshBuffers::*is)() const) const;
  bool all(bool (MeshBuffers::*are)() const) const;

  void draw_meshes(const Program&, Which which = Which::all) const;
  /// Rectangles whose vertex shaders find the corners: the ground's,
  void draw_ground(const Program&) const;
  /// those of visible lights,
  void draw_lights(const Program&, const std::vector<AreaLight>& visible) const;
  /// and the picture, with the program in use.
  void draw_full_screen() const;

private:
  std::vector<MeshBuffers> meshes_;
  VertexArray no_attributes_;
};

}  // namespace lagomorph::render::raster
