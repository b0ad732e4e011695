#pragma once

#include <string>
#include <vector>

#include "sim/pins.h"
#include "sim/settings.h"
#include "sim/types.h"

namespace lagomorph::sim {

/// Shapes that a body can start in, to see whether it finds its way back. [Smith et al. 2018, Fig. 6]
/// "rest"; "scramble": every vertex anywhere in the rest bounding box; "flatten": all on the plane across y
/// through the middle of the box. Pinned vertices are at rest in each.
std::vector<std::string> start_names();

/// Puts the body's vertices, of `vertices` among X, where it starts. `where` begins an InputError's message.
void set_start(const BodySettings&, const Range& vertices, const Points& X, const Pins&,
               const std::string& where, VecX& q);

}  // namespace lagomorph::sim
