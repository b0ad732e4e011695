#pragma once

#include <string>
#include <vector>

#include "render/settings.h"

namespace lagomorph::apps {

/// npy, exr (a file a channel), exr_multilayer (one file for the picture and all channels).
std::vector<std::string> channel_formats();

/// The files that a frame has in RUN/aov, by the names that records and RunPaths::channel() know them by:
/// "depth" is RUN/aov/depth/frame_0000.npy, "depth.exr" RUN/aov/depth/frame_0000.exr. The one of all channels
/// is "multilayer.exr". Statistics of tiles are .npy in any format: they are what `check` reads.
std::vector<std::string> channel_files(const render::RenderSettings&);

inline constexpr char multilayer_file[] = "multilayer.exr";
inline constexpr char exr_extension[] = ".exr";

}  // namespace lagomorph::apps
