#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/cli/options.h"
#include "apps/scene/scene_desc.h"

/// Drafts (--half) and parts (--region) of pictures, in terms of scene keys: they have an identity of their
/// own.
namespace lagomorph::apps {

/// What `--set` would say for them.
std::vector<std::string> draft_overrides(const SceneDesc&, const Options&);

/// The folder that they go to where none is given, beside that of the pictures proper, so that neither is
/// ever taken for the other: `out/bunny-half`.
std::filesystem::path draft_folder(const std::filesystem::path& run, const Options&);

/// The scene with them. `overrides` are those of --set.
SceneDesc load_scene_as_drawn(const std::filesystem::path& file, std::vector<std::string> overrides,
                              const Options&);

}  // namespace lagomorph::apps
