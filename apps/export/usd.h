#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/export/formats.h"

namespace lagomorph::apps {

/// One USD ASCII file of the whole sequence: a Mesh a body with points, normals and the chosen fields by time
/// sample, a UsdPreviewSurface each (what that has not: see usd_remarks), the scene's camera, by time sample
/// where it moves. USD keeps the samples of an attribute together, so the states are read once an attribute
/// and body. False: asked to stop.
bool write_usd(const ExportedSequence&, const std::filesystem::path& file);

/// Names of prims: letters, digits and _ only, no digit first, each its own; the others become _.
std::vector<std::string> prim_names(const std::vector<std::string>& names);

}  // namespace lagomorph::apps
