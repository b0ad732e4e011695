#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "render/camera.h"
#include "render/coat_albedo.h"
#include "render/path/light.h"
#include "render/path/medium.h"
#include "render/path/scene_geometry.h"
#include "render/raster/by_rays.h"
#include "render/raster/receivers.h"
#include "render/render_scene.h"

/// What rays of the rasterizer meet, and the light that comes from there.
namespace lagomorph::render::raster {

/// Suns that few rays would miss: their highlights are OpenGL's [sr].
constexpr float small_sun = 3e-3F;

/// Linear colours, interleaved, rows from the top: without any mesh, and without the clear ones, of which
/// `surfaces` says where meshes are. There smooth meshes mirror nothing yet.
struct DrawnPictures {
  std::span<const float> still, solid;
  SurfaceTexels surfaces;
};

class RayScene {
public:
  /// `drawn`: with_stand_ins() of the scene. Throws DeviceError as RayCaster does.
  RayScene(const RenderScene&, const RenderScene& drawn, const DrawnByRays&);

  path::SceneGeometry& geometry() { return geometry_; }
  const path::SceneGeometry& geometry() const { return geometry_; }

  struct Inside {
    path::Absorption absorption;
    float ior;
    float share;  // of the light that comes through the surface, which goes on inside
    Color lit;    // irradiance on the base from within, of the mean on the mesh from outside
  };
  /// A dielectric or a metal.
  struct Mirror {
    /// `part`: of what it mirrors.
    explicit Mirror(const Material&, float part = 1.0F);
    /// What it reflects along a cosine, of what it mirrors.
    Color reflectance(float cosine, const Color& base_color) const;

    float metallic, f0, share;
    static constexpr int cosines = 64;
    std::array<CoatAlbedo, cosines + 1> coat;
  };
  struct Surface {
    ByRays by_rays;
    float alpha = 0.0F;
    Color base_color, diffuse;  // the latter: what of it is not drawn by rays
    std::optional<Inside> inside;
    std::optional<Mirror> mirror;
  };
  const Surface& surface(std::size_t mesh) const { return surfaces_[mesh]; }
  /// alpha of the roughest of those that are drawn by rays.
  float roughest() const { return roughest_; }
  float ground_alpha() const { return ground_alpha_; }
  /// Of a mesh that mirrors by rays.
  Color mirrored_by_mesh(const path::MeshHit&, const path::TriangleHit&, float cosine) const;
  /// At a point of the ground, less its fade.
  Color mirrored_by_ground(const Vec3& point, float cosine) const;

  /// Whether the camera sees a light before that.
  bool light_is_before(const Ray&, double distance) const;
  /// Radiance of lights that a ray meets before that.
  Color light_met(const Ray&, double distance) const;
  Color sky(const Vec3& direction) const { return sky_radiance(sky_, direction); }
  /// Of the ground from where a ray meets it, as the picture without meshes shows it; outside of that, lit as
  /// if nothing were around.
  Color of_ground(const Camera&, const DrawnPictures&, const Vec3& point, const Vec3& direction) const;
  /// Of an opaque mesh, as the picture without clear meshes shows it where it is seen there; else as in the
  /// open.
  Color of_mesh(const Camera&, const DrawnPictures&, const path::MeshHit&, const path::TriangleHit&,
                const path::SurfacePoint&) const;

  /// Of the inner side of a half clear mesh: its base, under what light is inside.
  Color of_inner_base(std::size_t mesh, const Vec3& point) const;

private:
  Color mean_irradiance(const Vec3& point) const;
  Color irradiance(const Vec3& point, const Vec3& normal, const Color& from_below, bool with_shadows) const;
  bool is_hidden(const Vec3& from, const Vec3& light) const;
  static float trust(const Camera&, const DrawnPictures&, const path::SurfacePoint&, const Vec2& place);

  path::SceneGeometry geometry_;
  std::vector<Surface> surfaces_;             // of each mesh
  std::vector<path::RectangleLight> lights_;  // whose light is drawn
  std::vector<path::RectangleLight> met_;     // by rays: all of the scene, and suns that are not small
  std::array<Color, 6> ambient_;  // irradiance of sky and open ground on surfaces that face +x, -x, +y ...
  Ground ground_;
  Sky sky_;
  bool has_background_;  // a colour, which only the camera sees
  float roughest_ = 0.0F;
  float ground_alpha_;
  Mirror ground_mirror_;
};

}  // namespace lagomorph::render::raster
