#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/file_io.h"
#include "apps/pipeline/build_scene.h"
#include "apps/progress/progress.h"
#include "apps/scene/scene.h"
#include "sim/integrator.h"
#include "sim/mesh_io.h"
#include "sim/refine.h"

/// The bunny of the main job in mid-swing, for timing what is done with it.
namespace lagomorph::bench {

struct Swing {
  /// `name`: "5k" or "25k", a mesh of assets/meshes; "205k", the latter with each tet in eight; with "_soft",
  /// of young = 1e5 in steps of 0.01 s.
  explicit Swing(const std::string& name)
      : scene(apps::load_scene(std::filesystem::path(LAGOMORPH_SOURCE_DIR) / "assets/scenes/bunny.toml",
                               changes(name))),
        model(apps::build_model(scene, progress)),
        integrator(sim::make_integrator(scene.time, scene.solver, model)),
        state(model.initial_state()) {
    for (int frame = 0; frame < 16; ++frame) {
      sim::advance_frame(model, *integrator, scene.time, scene.solver, state);
    }
  }
  static std::vector<std::string> changes(const std::string& name) {
    const std::string mesh = name.substr(0, name.find('_'));
    std::vector<std::string> set = {
        "body.0.mesh=" + (mesh == "205k" ? refined_bunny().string() : "../meshes/bunny_" + mesh + ".msh")};
    if (name.ends_with("_soft"))
      set.insert(set.end(), {"body.0.material.young=1e5", "body.0.material.poisson=0.3", "time.fps=100",
                             "time.substeps=1"});
    return set;
  }
  /// In the folder for temporary files.
  static std::filesystem::path refined_bunny() {
    sim::Remarks remarks;
    const sim::TetMesh mesh = sim::refined(sim::read_tet_mesh(
        std::filesystem::path(LAGOMORPH_SOURCE_DIR) / "assets/meshes/bunny_25k.msh", remarks));
    std::filesystem::path file = std::filesystem::temp_directory_path() / "lagomorph_bench_205k.msh";
    apps::write_file(file, sim::write_tet_mesh(mesh, ".msh"));
    return file;
  }
  double h() const { return 1.0 / (scene.time.fps * scene.time.substeps); }

  apps::Progress progress{true};
  apps::SceneDesc scene;
  sim::Model model;
  std::unique_ptr<sim::Integrator> integrator;
  sim::State state;
};

/// Made once and kept, since it takes longer than what is timed.
inline Swing& swing(const std::string& name) {
  static std::map<std::string, Swing> made;
  return made.try_emplace(name, name).first->second;
}

}  // namespace lagomorph::bench
