#pragma once

#include <string>
#include <vector>

#include "render/render_scene.h"

namespace lagomorph::render {

std::vector<std::string> ground_texture_names();  // none, checker, grid

/// Part of ground.texture_color in the ground's colour at a point of it, 0 or 1: every other square of a
/// checker, the lines of a grid, whose lines at whole metres from the world's origin are three times as wide.
float ground_texture_at(const Ground&, const Vec3& point);
/// The ground's colour there.
Color ground_color_at(const Ground&, const Vec3& point);

}  // namespace lagomorph::render
