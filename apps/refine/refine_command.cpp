#include <filesystem>

#include <fmt/format.h>

#include "apps/cli/print.h"
#include "apps/commands.h"
#include "apps/file_io.h"
#include "apps/info/info.h"
#include "apps/pipeline/production.h"
#include "sim/mesh_io.h"
#include "sim/parallel.h"
#include "sim/refine.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

constexpr long long most_tets = 50'000'000;  // whose numbers fit 32 bits, and the machine

sim::TetMesh refined(sim::TetMesh mesh, int levels, const std::string& file) {
  for (int level = 0; level < levels; ++level) {
    if (8LL * mesh.tet_count() > most_tets) {
      wrong_input(fmt::format("{}: --levels {} makes more than {} tets; {} is the most", file, levels,
                              most_tets, level));
    }
    mesh = sim::refined(mesh);
  }
  return mesh;
}

}  // namespace

ExitStatus refine_command(const Options& options) {
  const fs::path file = options.inputs.at(0);
  if (!options.out) wrong_input("refine needs -o OUT.msh, the mesh to write");
  const fs::path out = *options.out;
  const std::vector<std::string> parts = sim::tet_mesh_parts(out.extension().string());  // before all work
  const sim::ThreadLimit limit(thread_count(options));
  sim::Remarks remarks;
  sim::TetMesh mesh = sim::read_tet_mesh(file, remarks);
  if (options.order == 1) mesh = sim::with_linear_tets(mesh);
  mesh = refined(std::move(mesh), options.levels.value_or(options.order ? 0 : 1), file.string());
  if (options.order == 2) mesh = sim::with_quadratic_tets(mesh);
  for (const std::string& part : parts)
    write_file(fs::path(out).replace_extension(part), sim::write_tet_mesh(mesh, part));
  const Report report = tet_mesh_info(out);
  if (options.json) {
    print(report.json());
  } else if (!options.quiet) {
    print(report.text());
  }
  return ExitStatus::done;
}

}  // namespace lagomorph::apps
