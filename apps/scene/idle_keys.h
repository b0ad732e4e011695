#pragma once

#include <string>
#include <vector>

#include "apps/scene/scene_desc.h"

namespace lagomorph::apps {

/// Keys of the pictures that are not at their defaults but have no effect in this scene, a line for each
/// reason.
std::vector<std::string> idle_keys(const SceneDesc&);

}  // namespace lagomorph::apps
