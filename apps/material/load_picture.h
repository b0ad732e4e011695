#pragma once

#include <string>
#include <vector>

#include "apps/material/load_curves.h"

namespace lagomorph::apps {

/// The curves as an SVG, a panel each: the material's stress as a line, its closed form as rings.
std::string load_svg(const std::string& model, const std::vector<LoadCurve>&);

}  // namespace lagomorph::apps
