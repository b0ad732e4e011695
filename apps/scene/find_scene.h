#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lagomorph::apps {

/// The folder of the program's own scenes/ and meshes/, from where the program stands: PREFIX/share/lagomorph
/// for PREFIX/bin, and the source's assets/ for a build tree out/build/<preset>. Empty when there is none.
std::filesystem::path asset_directory(const std::filesystem::path& program_directory);

/// A scene as it is given; when no such file exists and the path is relative, the scene of that name (with or
/// without `.toml`) among the program's own. The path as given when there is none either.
std::filesystem::path find_scene(const std::filesystem::path& given);

/// Names of the program's own scenes, in alphabetical order.
std::vector<std::string> own_scenes();

}  // namespace lagomorph::apps
