#pragma once

#include <filesystem>

#include "render/image_compare/error_map.h"

namespace lagomorph::apps {

/// Writes a map of errors as a picture in magma, with the folder it needs.
void write_heat_map(const std::filesystem::path& file, const render::ErrorMap&);

}  // namespace lagomorph::apps
