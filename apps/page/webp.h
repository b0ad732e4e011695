#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace lagomorph::apps {

/// PNG files of one size as WebP, by ffmpeg; none when it cannot. Works in the folder.
std::vector<std::string> webps(const std::vector<std::filesystem::path>& pngs,
                               const std::filesystem::path& folder, const std::function<bool()>& stop);

}  // namespace lagomorph::apps
