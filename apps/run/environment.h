#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "apps/scene/scene.h"

namespace lagomorph::apps {

/// What the bits of a state follow from beside the scene: the library that steps, BLAS and its kernel, the C
/// library, the instruction set.
std::vector<ResolvedKey> simulation_build_keys();
/// What the bits of a picture follow from beside its state: the whole program and the renderer's description.
std::vector<ResolvedKey> picture_build_keys(const std::string& renderer);

/// For run.json: versions of what the program stands on, and the machine.
nlohmann::ordered_json dependency_versions(const std::string& renderer);
nlohmann::ordered_json machine_description();

}  // namespace lagomorph::apps
