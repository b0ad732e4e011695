#include "apps/scene/scene.h"

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fstream>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/nearest.h"
#include "apps/scene/find_scene.h"
#include "apps/scene/read.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

/// No scene is larger; a mesh or a film that is taken for one need not be read whole.
constexpr std::size_t most_bytes = std::size_t{1} << 24;

std::string read_text(const fs::path& file) {
  std::error_code none;
  if (!fs::exists(file, none)) {
    const std::string own = joined(own_scenes());
    wrong_input(fmt::format("{}: there is no such scene{}", file.string(),
                            own.empty() ? "" : "; the program's own are " + own));
  }
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  std::string text;
  std::array<char, 65536> part;
  while (in && text.size() < most_bytes) {
    in.read(part.data(), part.size());
    text.append(part.data(), static_cast<std::size_t>(in.gcount()));
  }
  if (!in.is_open() || in.bad()) {
    wrong_input(fmt::format("{}: the scene cannot be read: {}", file.string(), std::strerror(errno)));
  }
  if (text.size() == most_bytes) {
    wrong_input(fmt::format("{}: larger than any scene", file.string()));
  }
  return text;
}

SceneDesc parse(std::string_view text, const fs::path& file, std::span<const std::string> overrides,
                Places& places) {
  SceneDesc scene = read_scene(text, file.string(), overrides, places);
  scene.directory = fs::absolute(file).parent_path().lexically_normal();
  resolve_scene(scene, places, file.stem().string());
  return scene;
}

}  // namespace

SceneDesc parse_scene(std::string_view text, const fs::path& file, std::span<const std::string> overrides) {
  Places places;
  return parse(text, file, overrides, places);
}

SceneDesc load_scene(const fs::path& file, std::span<const std::string> overrides) {
  Places places;
  SceneDesc scene = parse(read_text(file), file, overrides, places);
  check_scene_files(scene, places);
  return scene;
}

}  // namespace lagomorph::apps
