#pragma once

#include <filesystem>

#include "apps/export/formats.h"

namespace lagomorph::apps {

/// One binary glTF 2.0 file (.glb) of the whole sequence: a mesh a body, a morph target a frame after the
/// first, and an animation of their weights that blends from frame to frame, and of a camera that moves; its
/// field of view is that of the first frame. Two passes over the states: the bounds of each accessor stand
/// before the data. False: asked to stop. Throws Error(wrong_input) for more than the 4 GiB that the format
/// holds.
bool write_gltf(const ExportedSequence&, const std::filesystem::path& file);

}  // namespace lagomorph::apps
