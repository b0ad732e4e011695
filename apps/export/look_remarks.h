#pragma once

#include <string>
#include <vector>

#include "apps/export/formats.h"

namespace lagomorph::apps {

/// What the formats leave out of the bodies' looks, a line a body that loses something.
std::vector<std::string> gltf_remarks(const ExportedScene&);
std::vector<std::string> obj_remarks(const ExportedScene&);
std::vector<std::string> usd_remarks(const ExportedScene&);

}  // namespace lagomorph::apps
