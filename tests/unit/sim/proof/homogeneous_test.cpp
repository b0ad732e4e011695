#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sim/linear_solver.h"
#include "sim/statics.h"
#include "tests/support/ledger.h"
#include "tests/support/truth.h"
#include "tests/unit/sim/mesh_fixtures.h"
#include "tests/unit/sim/proof/bars.h"

/// A cube between sliding plates, one drawn apart: its sides and its force in closed form, whatever its mesh.
namespace lagomorph::sim {
namespace {

struct Case {
  std::string element, truth_model;
};
class Stretched : public testing::TestWithParam<Case> {};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const char* element : {"linear", "quadratic"})
    for (const char* model : {"nh_lecture", "snh", "snh_log", "stvk", "corotated"})
      all.push_back({element, model});
  return all;
}
INSTANTIATE_TEST_SUITE_P(Models, Stretched, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.element + "_" + info.param.truth_model; });

PinSettings plate(int axis, double place, double side) {
  PinSettings pin;
  Vec3 point = Vec3::Zero(), normal = Vec3::Zero();
  point[axis] = place;
  normal[axis] = side;
  pin.plane = PlaneSelector{point, normal};
  pin.axes = {std::string(1, "xyz"[axis])};
  return pin;
}

/// The unit cube with its inner vertices pushed about, between plates at 0 on all axes and at 1 on x, and for
/// two axes on y.
Model cube(const Case& c, double young, double poisson, bool biaxial) {
  BodyInput body{cube_mesh(3), {}};
  for (int v = 0; v < body.mesh.vertex_count(); ++v) {
    auto X = body.mesh.X.row(v);
    if (X.minCoeff() < 0.01 || X.maxCoeff() > 0.99) continue;
    for (int k = 0; k < 3; ++k) X[k] += 0.05 * std::sin(7.0 * v + 2.0 * k);
  }
  if (c.element == "quadratic") body.mesh = with_quadratic_tets(body.mesh);
  body.settings.material.model = truth::model_name(c.truth_model);
  body.settings.material.young = young;
  body.settings.material.poisson = poisson;
  for (int axis = 0; axis < 3; ++axis) body.settings.pin.push_back(plate(axis, 0.0, -1.0));
  for (int axis = 0; axis < (biaxial ? 2 : 1); ++axis) body.settings.pin.push_back(plate(axis, 1.0, 1.0));
  return Model({body}, Vec3::Zero());
}

/// Its force on the plate at x = 1: the gradient's sum there. [N]
double force(const Model& model, const VecX& q) {
  VecX g = VecX::Zero(q.size());
  for (const auto& term : model.energies()) term->add_gradient(q, 1.0, g);
  double sum = 0.0;
  for (int v = 0; v < model.mesh().vertex_count(); ++v)
    if (model.mesh().X(v, 0) > 1.0 - 1e-9) sum += g[3 * v];
  return sum;
}

/// Whether V has a minimum there: some models lose theirs, pressed or drawn far.
bool is_stable(const Model& model, const VecX& q) {
  BlockHessian K(model.pattern());
  K.set_zero();
  for (const auto& term : model.energies()) term->add_hessian(q, 1.0, HessianKind::exact, K);
  LinearSolver solver(1);
  solver.analyze(model.pattern(), model.pins());
  return solver.factorize(K) == FactorStatus::ok;
}

TEST_P(Stretched, MeetsTheClosedForm) {
  const auto truth = truth::json("6_analytic/homogeneous.json");
  double worst_side = 0.0, worst_force = 0.0;
  int compared = 0, unstable = 0;
  for (const auto& set : truth.at("sets")) {
    const double young = set.at("E");
    const auto& tests = set.at("models").at(GetParam().truth_model);
    for (const bool biaxial : {false, true}) {
      const Model model = cube(GetParam(), young, set.at("nu"), biaxial);
      for (const auto& row : tests.at(biaxial ? "equibiaxial_free_thickness" : "uniaxial_free_sides")) {
        const double stretch = row[0], side = row[1], stress = row[2];
        SolverSettings settings;
        settings.tolerance = 1e-10;
        State state = model.initial_state();
        const Points X = as_points(state.q);
        // From beside it, so that there is something to find.
        const Vec3 expected(stretch, biaxial ? stretch : side, side);
        for (int v = 0; v < X.rows(); ++v)
          state.q.segment<3>(3 * v) = X.row(v).transpose().cwiseProduct(expected);
        if (!is_stable(model, state.q)) {
          ++unstable;
          continue;
        }
        for (int dof = 0; dof < state.q.size(); ++dof)
          if (!model.pins().is_held(dof)) state.q[dof] += 0.002 * std::sin(static_cast<double>(dof));
        const NewtonReport report = static_equilibrium(model, settings, state.q);
        ASSERT_TRUE(is_good(report.status))
            << GetParam().truth_model << " at " << stretch << (biaxial ? ", two axes: " : ": ")
            << to_string(report.status) << " " << report.residual;
        for (int v = 0; v < X.rows(); ++v) {
          const Vec3 off = state.q.segment<3>(3 * v) - X.row(v).transpose().cwiseProduct(expected);
          worst_side = std::max(worst_side, off.cwiseAbs().maxCoeff());
        }
        worst_force = std::max(worst_force, std::abs(force(model, state.q) - stress) / young);
        ++compared;
      }
    }
  }
  EXPECT_EQ(compared + unstable, GetParam().truth_model == "corotated" ? 27 : 28);  // one has no equilibrium
  const bool is_neo_hookean = GetParam().truth_model != "stvk" && GetParam().truth_model != "corotated";
  EXPECT_LE(unstable, is_neo_hookean ? 0 : 9);
  EXPECT_LT(worst_side, 1e-12);
  EXPECT_LT(worst_force, 1e-12);
  tell("homogeneous",
       {"element", "model", "states", "of these not stable", "largest error of a position [m]",
        "of the force / (E A)"},
       {GetParam().element, truth::model_name(GetParam().truth_model), std::to_string(compared + unstable),
        std::to_string(unstable), told(worst_side), told(worst_force)});
}

}  // namespace
}  // namespace lagomorph::sim
