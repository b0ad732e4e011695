#pragma once

#include <filesystem>

#include "apps/cli/options.h"
#include "apps/info/report.h"

/// What each kind of input is. All throw Error or sim::InputError for what cannot be used.
namespace lagomorph::apps {

Report tet_mesh_info(const std::filesystem::path&);
Report tri_mesh_info(const std::filesystem::path&);
/// Writes the tet mesh without its stray vertices to `mended`, and tells what that is.
Report mend_tet_mesh(const std::filesystem::path&, const std::filesystem::path& mended);
/// A scene with its overrides, and the model that it makes.
Report scene_info(const std::filesystem::path&, const std::vector<std::string>& overrides);
/// A run: what was run and what of it is there.
Report run_info(const std::filesystem::path&);

}  // namespace lagomorph::apps
