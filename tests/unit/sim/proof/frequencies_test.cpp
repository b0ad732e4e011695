#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sim/integrator.h"
#include "tests/support/ledger.h"
#include "tests/support/modes.h"
#include "tests/unit/sim/mesh_fixtures.h"
#include "tests/unit/sim/proof/bars.h"

/// Natural frequencies: those of the generalized eigenproblem K φ = ω² M φ against the closed forms of bars
/// and beams, and those of the simulated motion against the eigenproblem.
namespace lagomorph::sim {
namespace frequencies_test {

constexpr double kPi = 3.14159265358979323846;
constexpr double kYoung = 1e6, kDensity = 1000.0;

/// A bar along x from 0 to `length`, held where x = 0.
Model bar(const Eigen::Vector3i& cells, double length, double thickness, double poisson,
          const std::string& element) {
  BodyInput body{bar_mesh(cells, Vec3(length, thickness, thickness), element), {}};
  body.settings.density = kDensity;
  body.settings.material.young = kYoung;
  body.settings.material.poisson = poisson;
  body.settings.pin.emplace_back().plane = PlaneSelector{Vec3::Zero(), Vec3(-1, 0, 0)};
  return Model({body}, Vec3::Zero());
}

/// The mode of the wanted kind with the lowest frequency: along x, or across it.
const Mode& first_mode(const std::vector<Mode>& modes, bool axial) {
  for (const Mode& mode : modes) {
    const auto u = as_points(mode.shape);
    const bool is_axial = u.col(0).squaredNorm() > u.col(1).squaredNorm() + u.col(2).squaredNorm();
    if (is_axial == axial) return mode;
  }
  throw std::runtime_error("no such mode among them");
}

struct Element {
  const char* name;
  int order;  // of the error in ω: twice the polynomial's degree
};
class Frequencies : public testing::TestWithParam<Element> {};
INSTANTIATE_TEST_SUITE_P(Elements, Frequencies,
                         testing::Values(Element{"linear", 2}, Element{"quadratic", 4}),
                         [](const auto& info) { return std::string(info.param.name); });

/// Without Poisson's effect a bar that swings along its axis is the one-dimensional one: ω = π/2 sqrt(E/ρ)/L.
TEST_P(Frequencies, OfAnAxialModeConvergeToTheWaveEquations) {
  const double length = 0.5, exact = 0.5 * kPi * std::sqrt(kYoung / kDensity) / length;
  std::vector<double> errors;
  for (const int n : {2, 4, 8}) {
    const Model model = bar({n, 1, 1}, length, 0.2, 0.0, GetParam().name);
    errors.push_back(first_mode(lowest_modes(model, 8), true).omega / exact - 1.0);
    tell("frequencies", {"element", "mode", "cells", "ω, FE [rad/s]", "ω, closed form", "error"},
         {GetParam().name, "axial, ν = 0", std::to_string(n), told(exact * (1.0 + errors.back())),
          told(exact), told(errors.back())});
  }
  for (const double error : errors) EXPECT_GT(error, 0.0);  // a consistent mass never swings too slowly
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), GetParam().order, 0.15);
}

/// A slender cantilever's first bending mode: ω = 1.8751² sqrt(E I/(ρ A L⁴)), less what shear and rotary
/// inertia take off, here some 0.1 %. [Timoshenko, Young and Weaver 1974, Sec. 5.9]
TEST_P(Frequencies, OfASlenderCantileverGoToBeamTheory) {
  const double length = 1.0, thickness = 0.05;
  const double beam = std::pow(1.875104068711961, 2) *
                      std::sqrt(kYoung * thickness * thickness / (12.0 * kDensity)) / (length * length);
  const bool quadratic = GetParam().order == 4;
  std::vector<double> errors;
  for (const int n : quadratic ? std::vector{10, 20} : std::vector{20, 40, 80}) {
    const int across = quadratic ? 1 : n / 20;
    const Model model = bar({n, across, across}, length, thickness, 0.0, GetParam().name);
    errors.push_back(first_mode(lowest_modes(model, 2), false).omega / beam - 1.0);
    tell("frequencies", {},
         {GetParam().name, "bending, ν = 0", std::to_string(n), told(beam * (1.0 + errors.back())),
          told(beam), told(errors.back())});
  }
  if (quadratic) {
    EXPECT_LT(std::abs(errors.back()), 0.005);
  } else {
    // Linear tets lock in bending; the error falls fourfold a refinement all the same.
    EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2.0, 0.4);
  }
}

/// Set off in one of its modes, ever so little, the body swings as one oscillator does: under the midpoint
/// rule by the angle 2 atan(ω h/2) a step.
TEST(Frequencies, OfTheMotionAreThoseOfTheEigenproblem) {
  const Model model = bar({8, 2, 2}, 1.0, 0.2, 0.3, "linear");
  const std::vector<Mode> modes = lowest_modes(model, 3);
  TimeSettings time;
  time.integrator = "implicit_midpoint";
  SolverSettings solver;
  solver.tolerance = 1e-9;
  for (const Mode& mode : modes) {
    time.fps = 12.0 * mode.omega / (2.0 * kPi);
    const double angle = 2.0 * std::atan(0.5 * mode.omega / time.fps);
    const auto integrator = make_integrator(time, solver, model);
    State state = model.initial_state();
    const VecX X = state.q;
    const double amplitude = 1e-7 / mode.shape.cwiseAbs().maxCoeff();  // [m √kg]
    state.q += amplitude * mode.shape;
    double worst = 0.0;
    for (int k = 1; k <= 60; ++k) {
      ASSERT_TRUE(is_good(advance_frame(model, *integrator, time, solver, state).status));
      const double part = mode.shape.dot(model.mass_times(state.q - X)) / amplitude;
      worst = std::max(worst, std::abs(part - std::cos(k * angle)));
    }
    EXPECT_LT(worst, 1e-4);
    tell("oscillation", {"mode", "ω [rad/s]", "largest error of the amplitude in 5 periods"},
         {std::to_string(&mode - modes.data()), told(mode.omega), told(worst)});
  }
}

}  // namespace frequencies_test
}  // namespace lagomorph::sim
