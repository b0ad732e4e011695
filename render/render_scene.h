#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/simd.h"
#include "render/sky_map.h"
#include "render/types.h"

/// What is drawn, the same for every back end. Lengths in metres, light in W/(sr m^2) (radiance), colours
/// linear.
namespace lagomorph::render {

/// A dielectric over a diffuse base, or a metal: GGX microfacets with Smith masking, Schlick's Fresnel. What
/// begins at 0 below the rasterizer draws in part; see raster/optics_stand_in.h. Of a surface that is not
/// opaque the rest is not there: light goes straight on.
struct Material {
  Color base_color =
      Color(0.8F, 0.8F, 0.8F);  // diffuse albedo, or a metal's reflectance at normal incidence, in [0, 1]
  float roughness = 0.5F;       // perceptual, alpha = roughness^2, in [0, 1]
  float metallic = 0.0F;        // 0 dielectric .. 1 metal
  float ior = 1.5F;             // index of refraction of the dielectric's coat, >= 1

  float transmission = 0.0F;                         // part of the dielectric with a clear inside, in [0, 1]
  Color absorption_color = Color::Ones();            // what the clear inside lets through, in [0, 1], over
  float absorption_distance = 1.0F;                  // [m], > 0
  float subsurface = 0.0F;                           // part of the base with a cloudy inside, in [0, 1]
  Color subsurface_color = Color(0.8F, 0.8F, 0.8F);  // albedo of a thick one, in [0, 1]
  Color subsurface_radius = Color(0.05F, 0.05F, 0.05F);  // mean free path there, by colour [m], > 0
  float coat = 0.0F;                                     // a clear varnish of index 1.5 over all, in [0, 1]
  float coat_roughness = 0.03F;                          // perceptual, in [0, 1]
  float sheen = 0.0F;                                    // fuzz over all, in [0, 1]
  Color sheen_tint = Color::Ones();                      // its colour, in [0, 1]
  float sheen_roughness = 0.5F;                          // in [0, 1]
  float opacity = 1.0F;                                  // part of the surface that is there, in [0, 1]
};

/// A triangle mesh whose vertices move. Normals follow: vertex_normals() of the current positions when
/// smooth.
struct Mesh {
  std::string name;
  std::vector<Triangle> triangles;  // counter-clockwise from outside
  std::vector<Vec3> positions;      // [m]
  Material material;
  bool smooth = true;  // false: one normal a triangle
  int body_id = 0;     // >= 0, written to the body id channel; the ground and what is behind it are -1
  std::vector<Color> colors = {};  // of each vertex, in place of base_color, in [0, 1]; none: the material's
};

/// A disc of floor that receives shadows and fades into the background: opaque up to `fade_start` from its
/// centre, gone at `radius`. In both back ends a fading point shows (1-w) of its shaded colour and w of what
/// lies behind.
struct Ground {
  bool enabled = true;
  float height = 0.0F;         // y of the plane
  Vec3 center = Vec3::Zero();  // y ignored
  float radius = 12.0F;        // > 0
  float fade_start = 3.0F;     // < radius
  Material material{Color(0.55F, 0.55F, 0.55F), 0.9F, 0.0F, 1.5F};
  std::string texture = "none";                   // see ground_texture_names()
  float texture_size = 0.5F;                      // side of a square [m], in [1e-3, 1e6]
  Color texture_color = Color(0.3F, 0.3F, 0.3F);  // of every other square, or the lines, in [0, 1]
  float line_width = 0.008F;                      // of a grid [m], > 0
  /// Of transparent pictures: the camera sees no ground, but as alpha the part of its light that meshes take.
  bool shadow_catcher = false;
};

/// A one-sided rectangle that shines from `position` towards `look_at`, Lambertian; `size` is width, height.
struct AreaLight {
  Vec3 position = Vec3(2.0F, 3.0F, 2.0F);
  Vec3 look_at = Vec3(0.0F, 0.5F, 0.0F);
  Vec2 size = Vec2(1.5F, 1.5F);
  Color color = Color(1.0F, 1.0F, 1.0F);
  float radiance = 10.0F;  // of white; times color [W/(sr m^2)]
  bool visible = false;    // seen by camera rays
  std::string name;        // for messages
};

/// The axes of a light's rectangle, unit vectors: width along `right`, height along `up`, shining along
/// `normal`. `up` is as near to +y as can be, to +z for a light that shines straight up or down.
struct LightFrame {
  Vec3 right, up, normal;
};

/// A disc infinitely far away, of one radiance.
struct Sun {
  Vec3 direction = Vec3(-0.4F, -1.0F, -0.6F);  // the way it shines, of any length but 0
  float angle = 0.53F;                         // its diameter [degrees], in [0.01, 90]
  Color color = Color(1.0F, 1.0F, 1.0F);
  float irradiance = 3.0F;  // of white, on a surface that faces it; times color [W/m^2]
  bool visible = false;     // seen by camera rays that meet nothing, where there is no background
  std::string name;         // for messages
};

/// Radiance by direction: horizon at and below y = 0, zenith straight up, blended by y^0.5; times strength.
/// With a map it is the map's, times strength.
struct Sky {
  Color zenith = Color(0.55F, 0.70F, 0.95F);
  Color horizon = Color(0.95F, 0.95F, 0.95F);
  float strength = 0.6F;
  std::shared_ptr<const SkyMap> map = nullptr;
};

struct RenderScene {
  std::vector<Mesh> meshes;
  Ground ground;
  std::vector<AreaLight> lights;
  std::vector<Sun> suns;
  Sky sky;
  std::optional<Color> background;  // what the camera sees where nothing is; the sky itself when not given
  // Straight pieces of a vertex' way while the shutter is open, see Renderer::set_motion(), in 0 .. 128; 0:
  // all stands still.
  int motion_segments = 0;
};

/// Throws SettingsError, naming the mesh, light or ground, the value and what would be right: indices, finite
/// numbers, ranges of materials, sizes.
void check_scene(const RenderScene&);
/// The same for new colours of a mesh's vertices: of a mesh that has colours, as many as it has.
void check_colors(const std::string& what, std::size_t vertices, std::span<const Color>);
LightFrame light_frame(const AreaLight&);
/// Radiance that arrives from a unit direction of the sky.
Color sky_radiance(const Sky&, const Vec3& direction);
/// What the camera sees along a direction that hits nothing.
Color background_radiance(const RenderScene&, const Vec3& direction);
/// Weight of the background at a point of the ground: 0 inside fade_start, 1 at radius and beyond, smoothstep
/// between.
float ground_fade(const Ground&, const Vec3& point);
/// The same at a distance from its centre.
LAGOMORPH_INLINE float fade_at(float distance, float fade_start, float radius) {
  const float x = std::min(std::max((distance - fade_start) / (radius - fade_start), 0.0F), 1.0F);
  return x * x * (3.0F - 2.0F * x);
}

}  // namespace lagomorph::render
