#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/export/moving_mesh.h"

namespace lagomorph::apps {

/// A body's look as a glTF material: metallic-roughness, and of the Khronos extensions for index of
/// refraction, transmission, volume, clearcoat and sheen those that it needs. A cloudy inside is a base of
/// its colour. The thickness of a clear inside is the shortest side of the body's bounding box.
nlohmann::ordered_json gltf_material(const MovingMesh&, const Extent&);

/// Names of the extensions that materials use, each once, in the order in which they are met.
std::vector<std::string> extensions_of(const nlohmann::ordered_json& materials);

}  // namespace lagomorph::apps
