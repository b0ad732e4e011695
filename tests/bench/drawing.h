#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/camera.h"
#include "render/renderer.h"
#include "tests/bench/scene.h"

namespace lagomorph::bench {

constexpr int threads = 2;

/// A picture of the swinging bunny, as the main job draws it.
struct Drawing {
  explicit Drawing(const std::string& backend, int samples, int width = 1280, int height = 720,
                   int renderer_threads = threads)
      : s(swing("5k")) {
    render::RenderSettings settings = s.scene.render;
    settings.backend = backend;
    settings.samples = samples;
    settings.width = width;
    settings.height = height;
    camera = std::make_unique<render::Camera>(s.scene.camera, width, height);
    surfaces = apps::build_surfaces(s.scene, s.model, s.progress);
    renderer = render::make_renderer(settings, renderer_threads);
    renderer->set_scene(apps::build_render_scene(s.scene, s.model, surfaces));
  }
  render::Image draw() {
    apps::move_meshes(*renderer, surfaces, s.state.q);
    return renderer->render(*camera, {});
  }

  Swing& s;
  std::unique_ptr<render::Camera> camera;
  std::vector<sim::Surface> surfaces;
  std::unique_ptr<render::Renderer> renderer;
};

}  // namespace lagomorph::bench
