#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render/settings.h"

namespace lagomorph::apps {

/// npy, exr and png (a file a channel), exr_multilayer (one file for the picture and all channels).
std::vector<std::string> channel_formats();

/// The files that a frame has in RUN/aov, by the names that records and RunPaths::channel() know them by:
/// "depth" is RUN/aov/depth/frame_0000.npy, "depth.exr" RUN/aov/depth/frame_0000.exr, "alpha.png" a .png. The
/// one of all channels is "multilayer.exr". Statistics of tiles are .npy in any format: they are what `check`
/// reads.
std::vector<std::string> channel_files(const render::RenderSettings&);

inline constexpr char multilayer_file[] = "multilayer.exr";
inline constexpr char exr_extension[] = ".exr";
inline constexpr char png_extension[] = ".png";

/// The extension of one of these files, and its channel.
std::string_view channel_extension(std::string_view file);
std::string_view channel_of(std::string_view file);

}  // namespace lagomorph::apps
