#include "apps/run/draft.h"

#include <algorithm>

#include <fmt/format.h>

#include "apps/scene/scene.h"

namespace lagomorph::apps {

std::vector<std::string> draft_overrides(const SceneDesc& scene, const Options& options) {
  const render::RenderSettings& r = scene.render;
  std::vector<std::string> set;
  std::vector<int> region = options.region.value_or(r.region);
  if (options.half) {
    set.push_back(fmt::format("render.width={}", (r.width + 1) / 2));
    set.push_back(fmt::format("render.height={}", (r.height + 1) / 2));
    set.push_back(fmt::format("render.samples={}", std::max(1, r.samples / 4)));
    set.push_back(fmt::format("render.path.min_samples={}", std::max(1, r.path.min_samples / 4)));
    if (!scene.panel.empty()) set.push_back(fmt::format("layout.gap={}", (scene.layout.gap + 1) / 2));
    // The region is in pixels of the whole: outwards to those of the half.
    for (std::size_t i = 0; i < region.size(); ++i) region[i] = (region[i] + (i < 2 ? 0 : 1)) / 2;
  }
  if (options.region || (options.half && !region.empty()))
    set.push_back(fmt::format("render.region=[{}]", fmt::join(region, ", ")));
  return set;
}

std::filesystem::path draft_folder(const std::filesystem::path& run, const Options& options) {
  std::filesystem::path folder = run.lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  if (options.half) folder += "-half";
  if (options.region) folder += "-region";
  return folder;
}

SceneDesc load_scene_as_drawn(const std::filesystem::path& file, std::vector<std::string> overrides,
                              const Options& options) {
  SceneDesc scene = load_scene(file, overrides);
  if (!options.half && !options.region) return scene;
  for (std::string& text : draft_overrides(scene, options)) overrides.push_back(std::move(text));
  return load_scene(file, overrides);
}

}  // namespace lagomorph::apps
