#include "render/raster/optics_stand_in.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "render/albedo.h"

namespace lagomorph::render::raster {

constexpr float mean_of_coat = 0.06F;  // what it reflects of most views

float mean_chord(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
  double volume = 0.0, area = 0.0;
  for (const Triangle& t : triangles) {
    const Eigen::Vector3d a = positions[t[0]].cast<double>();
    const Eigen::Vector3d b = positions[t[1]].cast<double>(), c = positions[t[2]].cast<double>();
    volume += a.dot(b.cross(c)) / 6.0;
    area += 0.5 * (b - a).cross(c - a).norm();
  }
  return area > 0.0 ? static_cast<float>(4.0 * std::abs(volume) / area) : 0.0F;
}

Material optics_stand_in(const Material& m, float thickness, ByRays by_rays) {
  Material clear = m;
  clear.absorption_color = by_rays.behind ? Color(Color::Zero())
                                          : Color(m.absorption_color.pow(thickness / m.absorption_distance));
  Material drawn = m;
  drawn.base_color = albedo(clear);
  if (by_rays.mirrored) {
    drawn.base_color *= 1.0F - mean_of_coat * m.coat;
  } else {
    drawn.roughness += m.coat * (std::min(m.roughness, m.coat_roughness) - m.roughness);
  }
  return drawn;
}

std::vector<std::string> optics_remarks(const RenderScene& scene, const RasterSettings& settings) {
  const DrawnByRays by_rays = drawn_by_rays(scene, settings);
  const std::string why_not =
      settings.rays ? ", beside colours or other bodies' opacity" : ", for raster.rays is off";
  std::vector<std::string> remarks;
  for (std::size_t k = 0; k < scene.meshes.size(); ++k) {
    const Mesh& mesh = scene.meshes[k];
    const Material& m = mesh.material;
    std::string what;
    const auto add = [&](bool there, const std::string& drawn) {
      if (there) what += (what.empty() ? "" : "; ") + drawn;
    };
    if (m.transmission > 0.0F && m.metallic < 1.0F) {
      add(true,
          by_rays.meshes[k].behind
              ? std::string("its shadow is as light as it is clear, without colours and caustics")
              : "transmission is an opaque base of absorption_color through its mean thickness" + why_not);
    }
    add(m.subsurface > 0.0F, "subsurface is an opaque base of subsurface_color");
    add(m.coat > 0.0F && !by_rays.meshes[k].mirrored,
        "coat sharpens the highlights instead of adding its own");
    add(is_smooth_mirror(m) && m.metallic > 0.0F && !by_rays.meshes[k].mirrored,
        settings.rays ? "it mirrors no bodies beside see-through ones"
                      : "it mirrors no bodies, for raster.rays is off");
    add(m.metallic > 0.5F && !is_smooth_mirror(m), "it mirrors lights and sky, and no bodies");
    if (!what.empty()) remarks.push_back("look of '" + mesh.name + "': " + what);
  }
  const Material& ground = scene.ground.material;
  if (scene.ground.enabled && !by_rays.ground &&
      (ground.metallic > 0.0F || (ground.ior > 1.0F && ground.roughness < 0.5F)))
    remarks.emplace_back("the ground mirrors lights and sky, and of bodies only that they hide the sky");
  return remarks;
}

}  // namespace lagomorph::render::raster
