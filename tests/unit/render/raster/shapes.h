#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "render/backends.h"

/// Small scenes whose pictures are known.
namespace lagomorph::render::raster {

constexpr float pi = std::numbers::pi_v<float>;

inline Material matte(float albedo) { return {Color::Constant(albedo), 1.0F, 0.0F, 1.0F}; }  // no coat

inline Mesh sphere(const Vec3& center, float radius, int rings = 48) {
  Mesh mesh;
  mesh.name = "sphere";
  mesh.material = matte(0.5F);
  const int sectors = 2 * rings;
  mesh.positions.emplace_back(center + Vec3(0.0F, radius, 0.0F));
  for (int r = 1; r < rings; ++r) {
    for (int s = 0; s < sectors; ++s) {
      const float theta = pi * static_cast<float>(r) / static_cast<float>(rings);
      const float phi = 2.0F * pi * static_cast<float>(s) / static_cast<float>(sectors);
      mesh.positions.emplace_back(center + radius * Vec3(std::sin(theta) * std::sin(phi), std::cos(theta),
                                                         std::sin(theta) * std::cos(phi)));
    }
  }
  mesh.positions.emplace_back(center - Vec3(0.0F, radius, 0.0F));
  const auto vertex = [&](int r, int s) {
    if (r == 0) return 0U;
    if (r == rings) return static_cast<std::uint32_t>(mesh.positions.size() - 1);
    return static_cast<std::uint32_t>(1 + (r - 1) * sectors + s % sectors);
  };
  for (int r = 0; r < rings; ++r) {
    for (int s = 0; s < sectors; ++s) {
      if (r > 0) mesh.triangles.push_back({vertex(r, s), vertex(r + 1, s), vertex(r, s + 1)});
      if (r < rings - 1) mesh.triangles.push_back({vertex(r, s + 1), vertex(r + 1, s), vertex(r + 1, s + 1)});
    }
  }
  return mesh;
}

/// An open rectangle, counter-clockwise as a x b points.
inline Mesh rectangle(const Vec3& center, const Vec3& half_a, const Vec3& half_b) {
  Mesh mesh;
  mesh.name = "rectangle";
  mesh.material = matte(0.5F);
  mesh.positions = {center - half_a - half_b, center + half_a - half_b, center + half_a + half_b,
                    center - half_a + half_b};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.smooth = false;
  return mesh;
}

/// A closed axis-aligned box.
inline Mesh box(const Vec3& low, const Vec3& high) {
  Mesh mesh;
  mesh.name = "box";
  mesh.material = matte(0.5F);
  for (int i = 0; i < 8; ++i) {
    mesh.positions.emplace_back((i & 1) ? high.x() : low.x(), (i & 2) ? high.y() : low.y(),
                                (i & 4) ? high.z() : low.z());
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  mesh.smooth = false;
  return mesh;
}

/// Nothing but black: no ground, no light, no sky.
inline RenderScene empty_scene() {
  RenderScene scene;
  scene.ground.enabled = false;
  scene.ground.material = matte(0.5F);
  scene.sky.strength = 0.0F;
  scene.background = Color::Zero();
  return scene;
}

inline CameraSettings three_quarter() {
  CameraSettings camera;
  camera.position = Vec3(1.5F, 1.2F, 3.0F);
  camera.look_at = Vec3(0.0F, 0.4F, 0.0F);
  return camera;
}

inline RenderSettings small_settings(int width = 96, int height = 64) {
  RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.raster.shadow_map = 512;
  settings.channels = {"depth"};
  return settings;
}

inline Image draw(const RenderScene& scene, const CameraSettings& camera, const RenderSettings& settings) {
  const auto renderer = make_raster_renderer(settings, 2);
  renderer->set_scene(scene);
  return renderer->render(Camera(camera, settings.width, settings.height), {});
}

inline Color color_at(const Image& image, int x, int y) {
  const float* c = image.find("color")->values.data() + 3 * (y * image.width() + x);
  return {c[0], c[1], c[2]};
}
inline float depth_at(const Image& image, int x, int y) {
  return image.find("depth")->values[static_cast<std::size_t>(y * image.width() + x)];
}
/// The pixel that a point is seen in.
inline Color color_of(const Image& image, const Camera& camera, const Vec3& point) {
  const Vec2 p = camera.project(point);
  return color_at(image, static_cast<int>(p.x()), static_cast<int>(p.y()));
}

}  // namespace lagomorph::render::raster
