#include "apps/scene/find_scene.h"

namespace lagomorph::apps {

namespace fs = std::filesystem;

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
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  const fs::path assets = none ? fs::path() : asset_directory(program.parent_path());
  if (assets.empty()) return given;
  for (const char* ending : {"", ".toml"}) {
    const fs::path scene = assets / "scenes" / (given.string() + ending);
    if (fs::is_regular_file(scene, none)) return scene;
  }
  return given;
}

}  // namespace lagomorph::apps
