#include "apps/scene/find_scene.h"

#include <algorithm>

namespace lagomorph::apps {

namespace fs = std::filesystem;

namespace {

fs::path own_assets() {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  return none ? fs::path() : asset_directory(program.parent_path());
}

}  // namespace

fs::path asset_directory(const fs::path& program_directory) {
  for (const char* place : {"../share/lagomorph", "../../../assets"}) {
    std::error_code none;
    const fs::path directory = (program_directory / place).lexically_normal();
    if (fs::is_directory(directory / "scenes", none)) return directory;
  }
  return {};
}

fs::path find_scene(const fs::path& given) {
  std::error_code none;
  if (given.is_absolute() || (fs::exists(given, none) && !fs::is_directory(given, none))) return given;
  const fs::path assets = own_assets();
  if (assets.empty()) return given;
  for (const char* ending : {"", ".toml"}) {
    const fs::path scene = assets / "scenes" / (given.string() + ending);
    if (fs::is_regular_file(scene, none)) return scene;
  }
  return given;
}

std::vector<std::string> own_scenes() {
  const fs::path assets = own_assets();
  if (assets.empty()) return {};
  std::vector<std::string> names;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(assets / "scenes", none)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace lagomorph::apps
