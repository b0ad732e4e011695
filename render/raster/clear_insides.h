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

/// Meshes with a clear inside: what is seen through them, and what they mirror where they are smooth, is
/// found by rays, refracted and reflected at every surface, that end in the pictures that are there already.
namespace lagomorph::render::raster {

/// What of a mesh is drawn so. Nothing where a mesh of the scene is see-through or it has colours of its
/// vertices. What it mirrors only where it is so smooth that few rays show that without noise, beside suns
/// that rays do not miss.
enum class ByRays { nothing, behind, behind_and_mirrored };
ByRays drawn_by_rays(const RenderScene&, const Mesh&);
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
    bool mirrors;             // in the eyes of the camera
    float ior, alpha, share;  // share: of the light that comes through the surface, the part inside goes on
  };
  struct Path;
  class Tile;

  Color radiance_of_ground(const Camera&, const Pictures&, const Vec3& point, const Vec3& direction) const;
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
  bool has_background_;  // a colour, which only the camera sees
  int samples_;          // rays a pixel
};

}  // namespace lagomorph::render::raster
