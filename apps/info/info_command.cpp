#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "apps/cli/print.h"
#include "apps/commands.h"
#include "apps/info/info.h"
#include "apps/nearest.h"
#include "apps/pipeline/production.h"
#include "apps/scene/find_scene.h"
#include "apps/scene/scene.h"
#include "sim/mesh_io.h"
#include "sim/parallel.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

enum class Kind { tet_mesh, tri_mesh, scene, run };

/// By the extension; a folder is a run, and so is what stands for one.
Kind kind_of(const fs::path& file) {
  std::error_code none;
  if (!fs::exists(file, none)) wrong_input(fmt::format("{}: there is no such file", file.string()));
  if (fs::is_directory(file, none)) return Kind::run;
  if (file.filename() == "run.json") return Kind::run;
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto among = [&](const std::vector<std::string>& all) {
    return std::find(all.begin(), all.end(), extension) != all.end();
  };
  if (extension == ".toml") return Kind::scene;
  if (among(sim::tet_mesh_extensions())) return Kind::tet_mesh;
  if (among(sim::tri_mesh_extensions())) return Kind::tri_mesh;
  wrong_input(
      fmt::format("{}: neither a scene (.toml), a tet mesh ({}), a surface ({}) nor the folder of a run",
                  file.string(), joined(sim::tet_mesh_extensions()), joined(sim::tri_mesh_extensions())));
}

Report report_of(const fs::path& file, const Options& options) {
  const Kind kind = kind_of(file);
  if (options.mend && kind != Kind::tet_mesh) {
    wrong_input(fmt::format("--mend is for tet meshes, and {} is none", file.string()));
  }
  if (!options.set.empty() && kind != Kind::scene) {
    wrong_input(fmt::format("--set is for scenes, and {} is none", file.string()));
  }
  switch (kind) {
    case Kind::tet_mesh:
      return options.mend ? mend_tet_mesh(file, *options.mend) : tet_mesh_info(file);
    case Kind::tri_mesh:
      return tri_mesh_info(file);
    case Kind::scene:
      return scene_info(file, options.set);
    case Kind::run:
      break;
  }
  return run_info(fs::is_directory(file) ? file : file.parent_path());
}

}  // namespace

ExitStatus info_command(const Options& options) {
  if (options.keys) {
    print(scene_key_table_markdown());
    return ExitStatus::done;
  }
  const sim::ThreadLimit limit(thread_count(options));
  const Report report = report_of(find_scene(options.inputs.at(0)), options);
  print(options.json ? report.json() : report.text());
  return ExitStatus::done;
}

}  // namespace lagomorph::apps
