#include "render/path/shading.h"

#include "render/albedo.h"
#include "render/ground_texture.h"

namespace lagomorph::render::path {

Shading::Shading(const RenderScene& scene)
    : ground(scene.ground),
      sky(scene.sky),
      background(scene.background),
      has_texture_(scene.ground.texture != "none") {
  const auto add = [&](const Material& material) {
    brdfs.emplace_back(material);
    albedos.push_back(albedo(material));
  };
  for (const Mesh& mesh : scene.meshes) {
    add(mesh.material);
    opacities.push_back(mesh.material.opacity);
    see_through = see_through || mesh.material.opacity < 1.0F;
  }
  add(scene.ground.material);
  float total = 0.0F;
  for (const AreaLight& light : scene.lights) {
    const RectangleLight rectangle(light);
    if (rectangle.power() <= 0.0F) continue;
    lights.push_back(rectangle);
    total += rectangle.power();
  }
  for (const RectangleLight& light : lights) pick.push_back(light.power() / total);
  float of_suns = 0.0F;
  for (const Sun& sun : scene.suns) {
    const SunLight disc(sun);
    if (disc.strength() <= 0.0F) continue;
    suns.push_back(disc);
    of_suns += disc.strength();
  }
  for (const SunLight& sun : suns) sun_pick.push_back(sun.strength() / of_suns);
  if (sky.map) sky_sampler.emplace(*sky.map);
}

Color Shading::open_view(const Vec3& direction) const {
  if (background) return *background;
  Color light = sky_radiance(sky, direction);
  for (const SunLight& sun : suns) {
    if (sun.visible() && sun.contains(direction)) light += sun.radiance();
  }
  return light;
}

std::optional<Color> Shading::textured_ground(const Vec3& point) const {
  if (!has_texture_) return std::nullopt;
  return ground_color_at(ground, point);
}

}  // namespace lagomorph::render::path
