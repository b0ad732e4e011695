#pragma once

#include <filesystem>

#include "apps/check/compare_frame.h"

namespace lagomorph::apps {

/// Writes of a frame whose pictures are still held OUT/heat/frame_0012.png, FLIP's errors in magma, and
/// OUT/panels/frame_0012.png, golden | new | heat; tells the result where they are.
void write_heat(const std::filesystem::path& out, ComparedFrame&);

/// Removes what earlier checks left there.
void remove_heat(const std::filesystem::path& out);

}  // namespace lagomorph::apps
