#pragma once

#include <memory>

#include "render/renderer.h"

/// The rows of the back-end table; each is made in its own folder.
namespace lagomorph::render {

std::unique_ptr<Renderer> make_raster_renderer(const RenderSettings&, int threads);  // raster/
std::unique_ptr<Renderer> make_path_renderer(const RenderSettings&, int threads);    // path/
std::unique_ptr<Renderer> make_null_renderer(const RenderSettings&, int threads);    // null_renderer.cpp

/// What a transparent picture is of: black where nothing is; only there a ground catches shadows.
inline void apply_transparency(const RenderSettings& settings, RenderScene& scene) {
  if (settings.transparent) scene.background = Color::Zero();
  scene.ground.shadow_catcher = scene.ground.shadow_catcher && settings.transparent;
}

}  // namespace lagomorph::render
