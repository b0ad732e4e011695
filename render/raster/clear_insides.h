#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "render/camera.h"
#include "render/path/dielectric.h"
#include "render/path/light.h"
#include "render/path/medium.h"
#include "render/path/scene_geometry.h"
#include "render/raster/receivers.h"
#include "render/raster/view_range.h"
#include "render/render_scene.h"

/// Meshes with a clear inside: OpenGL draws what they mirror, and what is seen through them is found by rays,
/// refracted and reflected at every surface, that end in the pictures that are there already.
namespace lagomorph::render::raster {

/// Whether a mesh of the scene is drawn so: no mesh may be see-through, and it has no colours of its
/// vertices.
bool is_drawn_clear(const RenderScene&, const Mesh&);
/// Part of the light that comes through such a mesh, where its mean thickness is `thickness` [m].
float light_through(const Material&, float thickness);

class ClearInsides {
public:
  /// Of a scene some of whose meshes are drawn so; with the lights that are drawn. Throws DeviceError as
  /// RayCaster does.
  ClearInsides(const RenderScene&, std::span<const AreaLight> lights);

  bool is_clear(std::size_t mesh) const { return insides_[mesh].has_value(); }
  /// Whether all meshes are.
  bool all_are_clear() const;
  void move(int mesh, std::span<const Vec3> positions) { geometry_.move(mesh, positions); }
  void show_ground(bool shown) { geometry_.show_ground(shown); }

  /// Linear colours, interleaved, rows from the top: without any mesh, and without the clear ones, of which
  /// `surfaces` says where meshes are.
  struct Pictures {
    std::span<const float> still, solid;
    SurfaceTexels surfaces;
  };
  /// Adds what is seen through them in a rectangle to the picture.
  void add(const Camera&, const Pictures&, const PixelRectangle&, std::span<float> color);

private:
  struct Inside {
    path::Absorption absorption;
    float ior, alpha, share;  // share: of the light that comes through the surface, the part inside goes on
  };
  struct Path;
  class Tile;

  Color radiance_of_ground(const Camera&, const Pictures&, const Vec3& point) const;
  Color radiance_of_mesh(const Camera&, const Pictures&, const path::MeshHit&, const path::TriangleHit&,
                         const path::SurfacePoint&) const;
  Color irradiance(const Vec3& point, const Vec3& normal) const;

  path::SceneGeometry geometry_;
  std::vector<std::optional<Inside>> insides_;  // of each mesh
  std::vector<Color> base_colors_;              // likewise
  std::vector<path::RectangleLight> lights_;
  std::vector<char> seen_lights_;  // lights that refracted rays show: 0 for small suns
  std::array<Color, 6> ambient_;   // irradiance of sky and open ground on surfaces that face +x, -x, +y ...
  Ground ground_;
  Sky sky_;
  int samples_;  // rays a pixel
};

}  // namespace lagomorph::render::raster
