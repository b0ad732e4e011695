#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sim/statics.h"
#include "tests/support/ledger.h"
#include "tests/unit/sim/mesh_fixtures.h"
#include "tests/unit/sim/proof/bars.h"

/// A slender cantilever that sags by next to nothing goes, refined, to beam theory.
namespace lagomorph::sim {
namespace sag_test {

struct Element {
  const char* name;
  std::vector<int> cells;  // along the beam
  double largest;          // error at the finest
};
class Sag : public testing::TestWithParam<Element> {};
INSTANTIATE_TEST_SUITE_P(Elements, Sag,
                         testing::Values(Element{"linear", {20, 40, 80}, 0.2},
                                         Element{"quadratic", {5, 10, 20}, 0.01}),
                         [](const auto& info) { return std::string(info.param.name); });

/// δ = w L⁴/(8 E I) + w L²/(2 κ G A), w = ρ A g, κ = 10 (1 + ν)/(12 + 11 ν): Euler and Bernoulli's bending
/// and Timoshenko's shear. [Cowper 1966] Without Poisson's effect, which a clamp would hold back.
TEST_P(Sag, ConvergesToTimoshenko) {
  const double length = 1.0, t = 0.05, young = 1e6, poisson = 0.0, density = 1000.0, gravity = 1e-4;
  const double w = density * t * t * gravity, shear = young / (2.0 * (1.0 + poisson));
  const double kappa = 10.0 * (1.0 + poisson) / (12.0 + 11.0 * poisson);
  const double bending = w * std::pow(length, 4) / (8.0 * young * std::pow(t, 4) / 12.0);
  const double beam = bending + w * length * length / (2.0 * kappa * shear * t * t);
  std::vector<double> errors;
  for (const int n : GetParam().cells) {
    const int across = std::max(1, n / 20);
    BodyInput body{bar_mesh({n, across, across}, Vec3(length, t, t), GetParam().name), {}};
    body.settings.density = density;
    body.settings.material.young = young;
    body.settings.material.poisson = poisson;
    body.settings.pin.emplace_back().plane = PlaneSelector{Vec3::Zero(), Vec3(-1, 0, 0)};
    const Model model({body}, Vec3(0, -gravity, 0));
    SolverSettings settings;
    settings.tolerance = 1e-9;
    State state = model.initial_state();
    ASSERT_TRUE(is_good(static_equilibrium(model, settings, state.q).status));
    double sag = 0.0;
    int corners = 0;
    for (int v = 0; v < model.mesh().vertex_count(); ++v) {
      if (model.mesh().X(v, 0) < length - 1e-9) continue;
      sag += model.mesh().X(v, 1) - state.q[3 * v + 1];
      ++corners;
    }
    sag /= corners;
    errors.push_back(sag / beam - 1.0);
    tell("sag", {"element", "cells", "sag, FE [m]", "Euler-Bernoulli", "Timoshenko", "error"},
         {GetParam().name, std::to_string(n), told(sag), told(bending), told(beam), told(errors.back())});
  }
  EXPECT_LT(std::abs(errors.back()), GetParam().largest);
  EXPECT_LT(std::abs(errors[2]), std::abs(errors[0]));
}

}  // namespace sag_test
}  // namespace lagomorph::sim
