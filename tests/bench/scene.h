#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/pipeline/build_scene.h"
#include "apps/progress/progress.h"
#include "apps/scene/scene.h"
#include "sim/integrator.h"

/// The bunny of the main job in mid-swing, for timing what is done with it.
namespace lagomorph::bench {

struct Swing {
  /// `tets`: "5k" or "25k", a mesh of assets/meshes.
  explicit Swing(const std::string& tets)
      : scene(apps::load_scene(std::filesystem::path(LAGOMORPH_SOURCE_DIR) / "assets/scenes/bunny.toml",
                               std::vector<std::string>{"body.0.mesh=../meshes/bunny_" + tets + ".msh"})),
        model(apps::build_model(scene, progress)),
        integrator(sim::make_integrator(scene.time, scene.solver, model)),
        state(model.initial_state()) {
    for (int frame = 0; frame < 16; ++frame) {
      sim::advance_frame(model, *integrator, scene.time, scene.solver, state);
    }
  }
  double h() const { return 1.0 / (scene.time.fps * scene.time.substeps); }

  apps::Progress progress{true};
  apps::SceneDesc scene;
  sim::Model model;
  std::unique_ptr<sim::Integrator> integrator;
  sim::State state;
};

/// Made once and kept, since it takes longer than what is timed.
inline Swing& swing(const std::string& tets) {
  static Swing small("5k");
  if (tets == "5k") return small;
  static Swing large("25k");
  return large;
}

}  // namespace lagomorph::bench
