#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
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
namespace homogeneous_test {

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
Model cube(const std::string& element, const MaterialSettings& material, bool biaxial) {
  BodyInput body{cube_mesh(3), {}};
  for (int v = 0; v < body.mesh.vertex_count(); ++v) {
    auto X = body.mesh.X.row(v);
    if (X.minCoeff() < 0.01 || X.maxCoeff() > 0.99) continue;
    for (int k = 0; k < 3; ++k) X[k] += 0.05 * std::sin(7.0 * v + 2.0 * k);
  }
  if (element == "quadratic") body.mesh = with_quadratic_tets(body.mesh);
  body.settings.material = material;
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

/// What was compared, and how well it was met.
struct Met {
  double worst_side = 0.0, worst_force = 0.0;
  int compared = 0, unstable = 0;
};

/// Draws the cube to where the closed form has it, from beside it, so that there is something to find.
void compare(const Model& model, double young, const Vec3& stretches, double stress, Met& met) {
  SolverSettings settings;
  settings.tolerance = 1e-10;
  State state = model.initial_state();
  const Points X = as_points(state.q);
  for (int v = 0; v < X.rows(); ++v) state.q.segment<3>(3 * v) = X.row(v).transpose().cwiseProduct(stretches);
  if (!is_stable(model, state.q)) {
    ++met.unstable;
    return;
  }
  for (int dof = 0; dof < state.q.size(); ++dof)
    if (!model.pins().is_held(dof)) state.q[dof] += 0.002 * std::sin(static_cast<double>(dof));
  const NewtonReport report = static_equilibrium(model, settings, state.q);
  ASSERT_TRUE(is_good(report.status))
      << stretches.transpose() << ": " << to_string(report.status) << " " << report.residual;
  for (int v = 0; v < X.rows(); ++v) {
    const Vec3 off = state.q.segment<3>(3 * v) - X.row(v).transpose().cwiseProduct(stretches);
    met.worst_side = std::max(met.worst_side, off.cwiseAbs().maxCoeff());
  }
  met.worst_force = std::max(met.worst_force, std::abs(force(model, state.q) - stress) / young);
  ++met.compared;
}

void tell_of(const std::string& element, const std::string& model, const Met& met) {
  EXPECT_LT(met.worst_side, 1e-12);
  EXPECT_LT(met.worst_force, 1e-12);
  tell("homogeneous",
       {"element", "model", "states", "of these not stable", "largest error of a position [m]",
        "of the force / (E A)"},
       {element, model, std::to_string(met.compared + met.unstable), std::to_string(met.unstable),
        told(met.worst_side), told(met.worst_force)});
}

MaterialSettings material_of(const std::string& model, double young, double poisson) {
  MaterialSettings m;
  m.model = model;
  m.young = young;
  m.poisson = poisson;
  return m;
}

TEST_P(Stretched, MeetsTheClosedForm) {
  const auto truth = truth::json("6_analytic/homogeneous.json");
  const std::string name = truth::model_name(GetParam().truth_model);
  Met met;
  for (const auto& set : truth.at("sets")) {
    const auto& tests = set.at("models").at(GetParam().truth_model);
    for (const bool biaxial : {false, true}) {
      const Model model = cube(GetParam().element, material_of(name, set.at("E"), set.at("nu")), biaxial);
      for (const auto& row : tests.at(biaxial ? "equibiaxial_free_thickness" : "uniaxial_free_sides")) {
        const double stretch = row[0], side = row[1], stress = row[2];
        compare(model, set.at("E"), Vec3(stretch, biaxial ? stretch : side, side), stress, met);
        if (HasFatalFailure()) return;
      }
    }
  }
  // One of corotated has no equilibrium.
  EXPECT_EQ(met.compared + met.unstable, GetParam().truth_model == "corotated" ? 27 : 28);
  const bool is_neo_hookean = GetParam().truth_model != "stvk" && GetParam().truth_model != "corotated";
  EXPECT_LE(met.unstable, is_neo_hookean ? 0 : 9);
  tell_of(GetParam().element, name, met);
}

/// The models that the reference has not, by their principal stresses P_i of stretches s.
struct Principal {
  const char* model;
  Vec3 (*stress)(const Vec3& s, double mu, double lambda);
};
class StretchedBy : public testing::TestWithParam<std::tuple<std::string, Principal>> {};

const Principal kPrincipal[] = {
    {"neo_hookean_log",
     [](const Vec3& s, double mu, double lambda) -> Vec3 {
       return mu * s + (lambda * std::log(s.prod()) - mu) * s.cwiseInverse();
     }},
    {"mooney_rivlin",  // C10 = 0.4 mu, C01 = 0.1 mu, bulk = lambda + 2 mu/3
     [](const Vec3& s, double mu, double lambda) -> Vec3 {
       const double J = s.prod(), I1 = s.squaredNorm(), I2 = J * J * s.cwiseInverse().squaredNorm();
       Vec3 P;
       for (int i = 0; i < 3; ++i) {
         P[i] =
             0.4 * mu * std::pow(J, -2.0 / 3.0) * (2.0 * s[i] - 2.0 / 3.0 * I1 / s[i]) +
             0.1 * mu * std::pow(J, -4.0 / 3.0) * (2.0 * s[i] * (I1 - s[i] * s[i]) - 4.0 / 3.0 * I2 / s[i]) +
             (lambda + 2.0 / 3.0 * mu) * (J - 1.0) * J / s[i];
       }
       return P;
     }},
    {"fixed_corotated",
     [](const Vec3& s, double mu, double lambda) -> Vec3 {
       const double J = s.prod();
       return 2.0 * mu * (s - Vec3::Ones()) + lambda * (J - 1.0) * J * s.cwiseInverse();
     }},
    {"arap", [](const Vec3& s, double mu, double) -> Vec3 { return 2.0 * mu * (s - Vec3::Ones()); }},
    {"linear",
     [](const Vec3& s, double mu, double lambda) -> Vec3 {
       return 2.0 * mu * (s - Vec3::Ones()) + Vec3::Constant(lambda * (s.sum() - 3.0));
     }},
    {"stress_strain",  // of data T = E log s: Hencky's
     [](const Vec3& s, double mu, double lambda) -> Vec3 {
       const Vec3 x = s.array().log();
       return (2.0 * mu * x + Vec3::Constant(lambda * x.sum())).cwiseQuotient(s);
     }},
};
INSTANTIATE_TEST_SUITE_P(Models, StretchedBy,
                         testing::Combine(testing::Values("linear", "quadratic"),
                                          testing::ValuesIn(kPrincipal)),
                         [](const auto& info) {
                           return std::get<0>(info.param) + "_" + std::get<1>(info.param).model;
                         });

TEST_P(StretchedBy, MeetsTheClosedForm) {
  const auto& [element, principal] = GetParam();
  constexpr double young = 1e6, poisson = 0.3;
  const double mu = young / (2.0 * (1.0 + poisson)), lambda = 2.0 * mu * poisson / (1.0 - 2.0 * poisson);
  MaterialSettings material = material_of(principal.model, young, poisson);
  if (material.model == "stress_strain")
    for (const double strain : {-0.4, -0.1, 0.2, 0.7})
      material.data.push_back({strain, young * std::log1p(strain) / (1.0 + strain)});
  Met met;
  for (const bool biaxial : {false, true}) {
    const Model model = cube(element, material, biaxial);
    for (const double stretch : {0.7, 0.85, 1.0, 1.15, 1.3, 1.6}) {
      // The free sides by halving.
      const auto at = [&](double side) { return Vec3(stretch, biaxial ? stretch : side, side); };
      double low = 0.2, high = 3.0;
      for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (principal.stress(at(middle), mu, lambda)[2] > 0.0 ? high : low) = middle;
      }
      compare(model, young, at(low), principal.stress(at(low), mu, lambda)[0], met);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_EQ(met.compared + met.unstable, 12);
  EXPECT_LE(met.unstable, 2);
  tell_of(element, principal.model, met);
}

}  // namespace homogeneous_test
}  // namespace lagomorph::sim
