#include "render/raster/by_rays.h"

#include <algorithm>

#include "render/albedo.h"
#include "render/path/dielectric.h"
#include "render/path/medium.h"
#include "render/raster/optics_stand_in.h"

namespace lagomorph::render::raster {
namespace {

constexpr float roughest_mirror = 0.35F;  // of the ground, that rays show

bool ground_mirrors(const Ground& ground) {
  const Material& m = ground.material;
  return ground.enabled && m.roughness <= roughest_mirror && (m.metallic > 0.0F || m.ior > 1.0F);
}

}  // namespace

bool DrawnByRays::any() const {
  return ground || std::any_of(meshes.begin(), meshes.end(), [](ByRays mesh) { return mesh.any(); });
}

DrawnByRays drawn_by_rays(const RenderScene& scene, const RasterSettings& settings) {
  DrawnByRays drawn{std::vector<ByRays>(scene.meshes.size()), false};
  if (!settings.rays) return drawn;
  drawn.ground = ground_mirrors(scene.ground);
  if (std::any_of(scene.meshes.begin(), scene.meshes.end(),
                  [](const Mesh& mesh) { return mesh.material.opacity < 1.0F; }))
    return drawn;
  for (std::size_t k = 0; k < scene.meshes.size(); ++k) {
    const Material& m = scene.meshes[k].material;
    ByRays& mesh = drawn.meshes[k];
    mesh.behind = clear_part(m) > 0.0F && scene.meshes[k].colors.empty();
    mesh.mirrored = is_smooth_mirror(m) && !(mesh.behind && m.coat > 0.0F);
  }
  return drawn;
}

bool is_smooth_mirror(const Material& m) {
  const Material mirror = m.coat > 0.0F ? coat_of(m) : m;
  return alpha_for_rays(mirror) <= rough_alpha && (mirror.metallic > 0.0F || mirror.ior > 1.0F);
}

float light_through(const Material& m, float thickness) {
  // In and out through surfaces at the mean angle.
  const float once = 1.0F - path::fresnel(2.0F / 3.0F, std::max(m.ior, 1.001F));
  const Color inside = path::Absorption(m).transmittance(thickness);
  // What is bent comes together elsewhere.
  const float straight = 1.0F - 0.6F * std::min(2.0F * (m.ior - 1.0F), 1.0F);
  return straight * clear_part(m) * once * once * path::luminance(path::f3(inside));
}

float opacity_to_light(const Mesh& mesh, bool clear) {
  const Material& m = mesh.material;
  return clear ? 1.0F - light_through(m, mean_chord(mesh.positions, mesh.triangles)) : m.opacity;
}

float alpha_for_rays(const Material& m) {
  const float alpha = m.roughness * m.roughness;
  return alpha <= smooth_alpha ? 0.0F : alpha;
}

}  // namespace lagomorph::render::raster
