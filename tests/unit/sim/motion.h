#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "sim/integrator.h"
#include "tests/support/truth.h"

/// Models in motion, for the tests of what steps them.
namespace lagomorph::sim {

inline const Vec3 kGravity(0, -9.81, 0);

/// All that are given inertia.
inline std::vector<std::string> dynamic_integrators() {
  std::vector<std::string> names = integrator_names();
  std::erase(names, "static");
  return names;
}

/// A model with its integrator and its state.
struct Motion {
  Model model;
  TimeSettings time;
  SolverSettings solver;
  std::unique_ptr<Integrator> integrator;
  State state;

  Motion(Model m, const std::string& name, double fps, double tolerance = 1e-11) : model(std::move(m)) {
    time.integrator = name;
    time.fps = fps;
    solver.tolerance = tolerance;
    integrator = make_integrator(time, solver, model);
    state = model.initial_state();
  }
  FrameReport advance() { return advance_frame(model, *integrator, time, solver, state); }
  void advance(int frames) {
    for (int k = 0; k < frames; ++k) {
      const FrameReport report = advance();
      ASSERT_TRUE(is_good(report.status)) << report.reason;
    }
  }
};

/// The truth's, held at y = 0.
inline Model reference_cube(const char* truth_model, const DampingSettings& damping = {}) {
  BodyInput body{truth::mesh("4b_cube_order/cube5.mesh"), {}};
  body.settings.material.model = truth::model_name(truth_model);
  body.settings.material.young = 1e5;
  body.settings.damping = damping;
  body.settings.pin.emplace_back().box = BoxSelector{Vec3(-1, 0, -1), Vec3(2, 0, 2)};
  return Model({body}, kGravity);
}

}  // namespace lagomorph::sim
