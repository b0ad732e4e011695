#include "render/raster/surface_table.h"

#include <cstddef>

#include "render/albedo.h"
#include "render/raster/optics_stand_in.h"
#include "render/raster/sky_model.h"
#include "render/raster/tables.h"

namespace lagomorph::render::raster {
namespace {

constexpr int sheen_table_size = 64;

SurfaceBlock surface_block(const Material& material, float thickness, ByRays by_rays) {
  const Material m = optics_stand_in(material, thickness, by_rays);
  const bool mirrors = !by_rays.mirrored || material.coat > 0.0F;  // the coat is another mirror
  return {vec4(m.base_color, mirrors ? 0.0F : -1.0F),
          Vec4(m.roughness, m.metallic, dielectric_f0(m), m.opacity), vec4(albedo(material), 0.0F),
          vec4(Color(m.sheen * m.sheen_tint), 0.5F)};
}

}  // namespace

SurfaceBlock matte_ground() {
  const Vec4 white(1.0F, 1.0F, 1.0F, 0.0F);
  return {white, Vec4(1.0F, 0.0F, 0.0F, 1.0F), white, Vec4::Zero()};
}

void SurfaceTable::set_scene(const RenderScene& scene, const DrawnByRays& by_rays,
                             const std::vector<AreaLight>& lights, bool sheen) {
  ground_ = surface_block(scene.ground.material, 1.0F, ByRays{});
  std::vector<SurfaceBlock> surfaces = {ground_};
  for (std::size_t k = 0; k < scene.meshes.size(); ++k) {
    const Mesh& mesh = scene.meshes[k];
    surfaces.push_back(
        surface_block(mesh.material, mean_chord(mesh.positions, mesh.triangles), by_rays.meshes[k]));
  }
  for (const AreaLight& light : lights)
    surfaces.push_back(
        {vec4(Color(light.radiance * light.color), 1.0F), Vec4::Zero(), Vec4::Zero(), Vec4::Zero()});
  const SurfaceBlock matte = matte_ground();
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, matte_ground_.id());
  glBufferData(GL_SHADER_STORAGE_BUFFER, sizeof(SurfaceBlock), &matte, GL_STATIC_DRAW);
  sheens_.reset();
  if (sheen) set_sheens(scene, surfaces);
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, surfaces_.id());
  glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(surfaces.size() * sizeof(SurfaceBlock)),
               surfaces.data(), GL_STATIC_DRAW);
}

/// A row of their table each, which the meshes' surfaces, from the second on, are told.
void SurfaceTable::set_sheens(const RenderScene& scene, std::vector<SurfaceBlock>& surfaces) {
  std::vector<float> roughnesses;
  for (const Mesh& mesh : scene.meshes) roughnesses.push_back(mesh.material.sheen_roughness);
  const auto rows = static_cast<int>(roughnesses.size());
  for (int k = 0; k < rows; ++k)
    surfaces[static_cast<std::size_t>(k) + 1].sheen.w() =
        (static_cast<float>(k) + 0.5F) / static_cast<float>(rows);
  sheens_.emplace();
  allocate_table(*sheens_, sheen_table_size, rows, sheen_table(roughnesses, sheen_table_size));
}

void SurfaceTable::bind_matte_ground() const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, matte_ground_.id());
}

void SurfaceTable::bind() const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, surfaces_.id());
  if (!sheens_) return;
  glActiveTexture(GL_TEXTURE3);
  glBindTexture(GL_TEXTURE_2D, sheens_->id());
}

}  // namespace lagomorph::render::raster
