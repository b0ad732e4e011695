#pragma once

#include "render/backends.h"
#include "tests/unit/render/path/shapes.h"

namespace lagomorph::render {

/// A sphere on the ground under a wide light, with noise in the penumbra.
inline RenderScene lit_sphere() {
  RenderScene scene;
  scene.meshes = {make_sphere(3, 0.5F, Vec3(0, 0.5F, 0))};
  AreaLight light;
  light.position = Vec3(2, 3, 1);
  scene.lights = {light};
  return scene;
}

/// Small pictures of it by the path tracer.
inline RenderSettings lit_sphere_settings(int samples) {
  RenderSettings s;
  s.backend = "path";
  s.width = 96;
  s.height = 64;
  s.samples = samples;
  s.path.bounces = 2;
  return s;
}

inline Image draw_lit_sphere(const RenderScene& scene, const RenderSettings& s, int threads) {
  CameraSettings c;
  c.position = Vec3(0, 1.2F, 4);
  c.look_at = Vec3(0, 0.4F, 0);
  c.fov = 35.0F;
  const auto renderer = make_path_renderer(s, threads);
  renderer->set_scene(scene);
  return renderer->render(Camera(c, s.width, s.height), {});
}

}  // namespace lagomorph::render
