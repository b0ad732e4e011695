#include "render/render_scene.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "render/error.h"
#include "render/ground_texture.h"

namespace lagomorph::render {
namespace {

void check_range(const std::string& what, float value, float low, float high, const char* right) {
  if (value >= low && value <= high) return;
  throw SettingsError(what + " = " + std::to_string(value) + " must be " + right);
}

constexpr float largest = 1e6F;  // [m], [W/(sr m^2)]: beyond, single precision draws nothing sensible

void check_color(const std::string& what, const Color& color, float high, const char* right) {
  for (int i = 0; i < 3; ++i) check_range(what, color[i], 0.0F, high, right);
}

void check_point(const std::string& what, const Vec3& point) {
  for (int i = 0; i < 3; ++i) check_range(what, point[i], -largest, largest, "finite, within 1e6 m");
}

void check_material(const std::string& what, const Material& m) {
  check_color(what + " base_color", m.base_color, 1.0F, "in [0, 1]");
  check_range(what + " roughness", m.roughness, 0.0F, 1.0F, "in [0, 1]");
  check_range(what + " metallic", m.metallic, 0.0F, 1.0F, "in [0, 1]");
  check_range(what + " ior", m.ior, 1.0F, 10.0F, "in [1, 10]");
  check_range(what + " transmission", m.transmission, 0.0F, 1.0F, "in [0, 1]");
  check_color(what + " absorption_color", m.absorption_color, 1.0F, "in [0, 1]");
  check_range(what + " absorption_distance", m.absorption_distance, 1e-6F, largest, "in [1e-6, 1e6] m");
  check_range(what + " subsurface", m.subsurface, 0.0F, 1.0F, "in [0, 1]");
  check_color(what + " subsurface_color", m.subsurface_color, 1.0F, "in [0, 1]");
  for (int i = 0; i < 3; ++i)
    check_range(what + " subsurface_radius", m.subsurface_radius[i], 1e-6F, largest, "in [1e-6, 1e6] m");
  check_range(what + " coat", m.coat, 0.0F, 1.0F, "in [0, 1]");
  check_range(what + " coat_roughness", m.coat_roughness, 0.0F, 1.0F, "in [0, 1]");
  check_range(what + " sheen", m.sheen, 0.0F, 1.0F, "in [0, 1]");
  check_color(what + " sheen_tint", m.sheen_tint, 1.0F, "in [0, 1]");
  check_range(what + " sheen_roughness", m.sheen_roughness, 0.0F, 1.0F, "in [0, 1]");
  check_range(what + " opacity", m.opacity, 0.0F, 1.0F, "in [0, 1]");
}

void check_mesh(const Mesh& mesh, std::size_t index) {
  const std::string what = "mesh " + (mesh.name.empty() ? std::to_string(index) : "'" + mesh.name + "'");
  check_material(what, mesh.material);
  if (mesh.body_id < 0)
    throw SettingsError(what + " body_id = " + std::to_string(mesh.body_id) + " must be >= 0");
  for (const Vec3& x : mesh.positions) check_point(what + " position", x);
  if (!mesh.colors.empty()) check_colors(what, mesh.positions.size(), mesh.colors);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (v < mesh.positions.size()) continue;
      throw SettingsError(what + " triangle " + std::to_string(t) + " has vertex " + std::to_string(v) +
                          "; it must be below the number of positions, " +
                          std::to_string(mesh.positions.size()));
    }
  }
}

void check_light(const AreaLight& light, std::size_t index) {
  const std::string what = "light " + std::to_string(index);
  check_point(what + " position", light.position);
  check_point(what + " look_at", light.look_at);
  if (!((light.look_at - light.position).norm() > 0.0F))
    throw SettingsError(what + " position and look_at must differ");
  for (int i = 0; i < 2; ++i) {
    if (!(light.size[i] > 0.0F && light.size[i] <= largest))
      throw SettingsError(what + " size = " + std::to_string(light.size[i]) + " must be above 0 m");
  }
  check_color(what + " color", light.color, largest, "finite, >= 0");
  check_range(what + " radiance", light.radiance, 0.0F, largest, "finite, >= 0");
}

void check_sun(const Sun& sun, std::size_t index) {
  const std::string what = "sun " + std::to_string(index);
  check_point(what + " direction", sun.direction);
  if (!(sun.direction.norm() > 0.0F)) throw SettingsError(what + " direction must not be 0");
  check_range(what + " angle", sun.angle, 0.01F, 90.0F, "in [0.01, 90] degrees");
  check_color(what + " color", sun.color, largest, "finite, >= 0");
  check_range(what + " irradiance", sun.irradiance, 0.0F, largest, "finite, >= 0");
}

void check_ground(const Ground& ground) {
  check_material("ground", ground.material);
  check_point("ground center", ground.center);
  check_range("ground height", ground.height, -largest, largest, "finite, within 1e6 m");
  if (!(ground.radius > 0.0F && ground.radius <= largest))
    throw SettingsError("ground radius = " + std::to_string(ground.radius) + " must be above 0 m");
  const std::vector<std::string> textures = ground_texture_names();
  if (std::find(textures.begin(), textures.end(), ground.texture) == textures.end())
    throw SettingsError("unknown ground texture '" + ground.texture + "'; known are none, checker, grid");
  check_range("ground texture_size", ground.texture_size, 1e-3F, largest, "in 0.001 .. 1e6 m");
  check_range("ground line_width", ground.line_width, 1e-6F, largest, "in 1e-6 .. 1e6 m");
  check_color("ground texture_color", ground.texture_color, 1.0F, "in 0 .. 1");
  if (!(ground.fade_start >= 0.0F && ground.fade_start < ground.radius)) {
    throw SettingsError("ground fade_start = " + std::to_string(ground.fade_start) +
                        " must be >= 0 and below radius");
  }
}

}  // namespace

void check_scene(const RenderScene& scene) {
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) check_mesh(scene.meshes[i], i);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) check_light(scene.lights[i], i);
  for (std::size_t i = 0; i < scene.suns.size(); ++i) check_sun(scene.suns[i], i);
  if (scene.ground.enabled) check_ground(scene.ground);
  check_color("sky zenith", scene.sky.zenith, largest, "finite, >= 0");
  check_color("sky horizon", scene.sky.horizon, largest, "finite, >= 0");
  check_range("sky strength", scene.sky.strength, 0.0F, largest, "finite, >= 0");
  if (scene.background) check_color("background", *scene.background, largest, "finite, >= 0");
  if (scene.motion_segments < 0 || scene.motion_segments > 128) {
    throw SettingsError("motion_segments = " + std::to_string(scene.motion_segments) +
                        " must be in 0 .. 128, the most that the hierarchy holds");
  }
}

void check_colors(const std::string& what, std::size_t vertices, std::span<const Color> colors) {
  if (colors.size() != vertices) {
    throw SettingsError(what + " has " + std::to_string(colors.size()) + " colors for " +
                        std::to_string(vertices) + " vertices");
  }
  const auto right = [](const Color& c) { return (c >= 0.0F && c <= 1.0F).all(); };  // NaN is not
  for (const Color& color : colors) {
    if (!right(color)) check_color(what + " color", color, 1.0F, "in [0, 1]");
  }
}

LightFrame light_frame(const AreaLight& light) {
  const Vec3 normal = (light.look_at - light.position).normalized();
  const Vec3 upwards = std::abs(normal.y()) < 0.9999F ? Vec3::UnitY() : Vec3::UnitZ();
  const Vec3 right = normal.cross(upwards).normalized();
  return {right, right.cross(normal), normal};
}

Color sky_radiance(const Sky& sky, const Vec3& direction) {
  if (sky.map) return sky.strength * sky.map->radiance(direction);
  const float w = std::sqrt(std::max(direction.y(), 0.0F));
  return sky.strength * ((1.0F - w) * sky.horizon + w * sky.zenith);
}

Color background_radiance(const RenderScene& scene, const Vec3& direction) {
  return scene.background ? *scene.background : sky_radiance(scene.sky, direction);
}

float ground_fade(const Ground& ground, const Vec3& point) {
  const Vec2 d(point.x() - ground.center.x(), point.z() - ground.center.z());
  return fade_at(d.norm(), ground.fade_start, ground.radius);
}

}  // namespace lagomorph::render
