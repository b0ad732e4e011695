#pragma once

#include <memory>

#include "render/renderer.h"

/// The rows of the back-end table; each is made in its own folder.
namespace lagomorph::render {

std::unique_ptr<Renderer> make_raster_renderer(const RenderSettings&, int threads);  // raster/
std::unique_ptr<Renderer> make_path_renderer(const RenderSettings&, int threads);    // path/
std::unique_ptr<Renderer> make_null_renderer(const RenderSettings&, int threads);    // null_renderer.cpp

}  // namespace lagomorph::render
