#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "render/image_compare/light_noise.h"

namespace lagomorph::apps {

/// Where a channel lies beside a picture: ROOT/aov/<channel>/frame_0012.npy of ROOT/frames/frame_0012.png,
/// in a run, a golden and its variants; of a picture in a plain folder, FOLDER/aov/....
std::filesystem::path channel_beside(const std::filesystem::path& picture, std::string_view channel);

/// The tile_statistics beside a picture of this size; none where there are none. Throws Error(wrong_input)
/// for a file that is none, or of another size.
std::optional<render::LightStatistics> read_light_statistics(const std::filesystem::path& picture, int width,
                                                             int height);

}  // namespace lagomorph::apps
