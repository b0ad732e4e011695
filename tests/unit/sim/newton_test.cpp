#include "sim/newton.h"

#include <gtest/gtest.h>

#include "sim/kinematics.h"
#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace newton_test {

/// A soft cube held at its bottom.
Model cube_model(const std::string& material = "stable_neo_hookean",
                 const Vec3& gravity = Vec3(0, -9.81, 0)) {
  BodyInput body{cube_mesh(3), {}};
  body.settings.material.model = material;
  body.settings.material.young = 3e4;
  body.settings.pin.emplace_back().bottom = 0.1;
  return Model({body}, gravity);
}

/// A backward Euler step from where the cube is pulled upwards.
IncrementalPotential step_from_rest(const Model& model, double h, const Vec3& velocity) {
  State state = model.initial_state();
  IncrementalPotential phi;
  phi.m = 1.0 / (h * h);
  VecX v = velocity.replicate(model.mesh().vertex_count(), 1);
  model.pins().clear_pinned(v);
  phi.q_predicted = state.q + h * v;
  return phi;
}

/// M (q - q̃)/h² + ∂V/∂q over the free vertices, recomputed here.
double force_imbalance(const Model& model, const IncrementalPotential& phi, const VecX& q) {
  VecX g = phi.m * (model.mass() * (q - phi.q_predicted));
  for (const auto& term : model.energies()) term->add_gradient(q, 1.0, g);
  return model.pins().free_norm(g);
}

double smallest_determinant(const Model& model, const VecX& q) {
  const VecX X = model.initial_state().q;
  double smallest = std::numeric_limits<double>::infinity();
  for (const Tet& tet : model.mesh().tets) {
    const auto D = dphi_dX(gather_corners(X, tet));
    smallest = std::min(smallest, deformation_gradient(gather_corners(q, tet), D).determinant());
  }
  return smallest;
}

class NewtonOn : public testing::TestWithParam<const char*> {};

TEST_P(NewtonOn, MeetsItsToleranceInNewtons) {
  const Model model = cube_model(GetParam());
  const IncrementalPotential phi = step_from_rest(model, 1.0 / 30.0, Vec3(0, 1, 0.5));
  for (const double tolerance : {0.5, 1e-3, 1e-6, 1e-9}) {
    SolverSettings settings;
    settings.tolerance = tolerance;
    VecX q = model.initial_state().q;
    const NewtonReport report = Newton(model, settings).minimize(model, phi, q);
    EXPECT_EQ(report.status, StepStatus::converged);
    EXPECT_LE(report.residual, tolerance);
    const double weight = model.pins().free_norm(model.gravity_force());
    EXPECT_NEAR(force_imbalance(model, phi, q) / weight, report.residual, 1e-12);
  }
}

TEST_P(NewtonOn, IsQuadratic) {
  const Model model = cube_model(GetParam());
  const IncrementalPotential phi = step_from_rest(model, 1.0 / 30.0, Vec3(0, 1, 0.5));
  std::vector<double> residuals;
  for (int iterations = 1; iterations <= 8; ++iterations) {
    SolverSettings settings;
    settings.max_iterations = iterations;
    settings.tolerance = 1e-15;
    VecX q = model.initial_state().q;
    residuals.push_back(Newton(model, settings).minimize(model, phi, q).residual);
  }
  // Where it converges, each residual is the square of the one before, up to a factor.
  int quadratic = 0;
  for (std::size_t k = 1; k < residuals.size(); ++k)
    if (residuals[k - 1] < 1e-1 && residuals[k - 1] > 1e-7 &&
        residuals[k] < 100.0 * residuals[k - 1] * residuals[k - 1])
      ++quadratic;
  EXPECT_GE(quadratic, 2) << testing::PrintToString(residuals);
}

/// Any tolerance in (0, 1) is legal: what rounding cannot reach ends as such, near the smallest residual that
/// there is.
TEST_P(NewtonOn, EndsAtTheRoundingFloorWhenAskedForMore) {
  for (const double far : {0.0, 1e4}) {
    BodyInput body{cube_mesh(3), {}};
    body.settings.material.model = GetParam();
    body.settings.translate = Vec3(far, 0, 0);
    body.settings.pin.emplace_back().bottom = 0.1;
    const Model model({body}, Vec3(0, -9.81, 0));
    const IncrementalPotential phi = step_from_rest(model, 1.0 / 30.0, Vec3(0, 1, 0.5));
    for (const double tolerance : {1e-14, 1e-100}) {
      SolverSettings settings;
      settings.tolerance = tolerance;
      VecX q = model.initial_state().q;
      const NewtonReport report = Newton(model, settings).minimize(model, phi, q);
      EXPECT_EQ(report.status, StepStatus::rounding_floor);
      EXPECT_LE(report.iterations, 12);
      EXPECT_LT(report.residual, far == 0.0 ? 1e-11 : 1e-8);
    }
  }
}

TEST_P(NewtonOn, FindsTheSameMinimumWithProjectedHessians) {
  const Model model = cube_model(GetParam());
  const IncrementalPotential phi = step_from_rest(model, 1.0 / 30.0, Vec3(0, 1, 0.5));
  SolverSettings settings;
  settings.tolerance = 1e-11;
  VecX exact = model.initial_state().q, projected = exact;
  EXPECT_EQ(Newton(model, settings).minimize(model, phi, exact).status, StepStatus::converged);
  settings.hessian = "projected";
  EXPECT_EQ(Newton(model, settings).minimize(model, phi, projected).status, StepStatus::converged);
  EXPECT_LT((exact - projected).cwiseAbs().maxCoeff(), 1e-11);
}

/// However its linear systems are solved, and however loosely, the minimum is the same.
TEST_P(NewtonOn, FindsTheSameMinimumByEachSolver) {
  const Model model = cube_model(GetParam());
  const IncrementalPotential phi = step_from_rest(model, 1.0 / 30.0, Vec3(0, 1, 0.5));
  std::vector<VecX> minima;
  for (const char* const linear : {"cholmod", "cg", "auto"}) {
    SolverSettings settings;
    settings.tolerance = 1e-11;
    settings.linear = linear;
    VecX& q = minima.emplace_back(model.initial_state().q);
    const NewtonReport report = Newton(model, settings).minimize(model, phi, q);
    EXPECT_EQ(report.status, StepStatus::converged) << linear;
    EXPECT_LE(report.iterations, 12) << linear;
  }
  EXPECT_LT((minima[0] - minima[1]).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_LT((minima[0] - minima[2]).cwiseAbs().maxCoeff(), 1e-11);
}

/// Without gravity the largest of the parts that must cancel measures the residual.
TEST_P(NewtonOn, ConvergesWithoutGravity) {
  const Model model = cube_model(GetParam(), Vec3::Zero());
  const IncrementalPotential phi = step_from_rest(model, 1.0 / 30.0, Vec3(0, 1, 0.5));
  SolverSettings settings;
  settings.tolerance = 1e-8;
  VecX q = phi.q_predicted;
  const NewtonReport report = Newton(model, settings).minimize(model, phi, q);
  EXPECT_EQ(report.status, StepStatus::converged);
  VecX inertia = phi.m * (model.mass() * (q - phi.q_predicted));
  EXPECT_NEAR(report.residual, force_imbalance(model, phi, q) / model.pins().free_norm(inertia), 1e-10);
  EXPECT_GT(report.iterations, 1);
}

INSTANTIATE_TEST_SUITE_P(Materials, NewtonOn,
                         testing::Values("neo_hookean", "stable_neo_hookean", "stable_neo_hookean_log"),
                         [](const auto& info) { return std::string(info.param); });

TEST(Newton, HasConvergedWhereNothingPulls) {
  const Model model = cube_model("stable_neo_hookean", Vec3::Zero());
  VecX q = model.initial_state().q;
  const VecX before = q;
  const NewtonReport report = Newton(model, {}).minimize(model, step_from_rest(model, 0.1, Vec3::Zero()), q);
  EXPECT_TRUE(is_good(report.status));
  EXPECT_LT((q - before).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Newton, HasNothingToSolveWhenAllIsPinned) {
  BodyInput body{cube_mesh(2), {}};
  body.settings.pin.emplace_back().top = 1.0;
  const Model model({body}, Vec3(0, -9.81, 0));
  VecX q = model.initial_state().q;
  const NewtonReport report = Newton(model, {}).minimize(model, step_from_rest(model, 0.1, Vec3(1, 1, 1)), q);
  EXPECT_EQ(report.status, StepStatus::converged);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_EQ(q, model.initial_state().q);
}

/// Thrown at its floor, a cube of the lecture's energy is flattened, yet no tet inverts on the way nor at the
/// end.
TEST(Newton, NeverInvertsANeoHookeanTet) {
  const Model model = cube_model("neo_hookean");
  const IncrementalPotential phi = step_from_rest(model, 1.0 / 30.0, Vec3(0, -60, 0));
  VecX q = model.initial_state().q;
  const NewtonReport report = Newton(model, {}).minimize(model, phi, q);
  EXPECT_EQ(report.status, StepStatus::converged);
  const double smallest_J = smallest_determinant(model, q);
  EXPECT_GT(smallest_J, 0.0);
  EXPECT_LT(smallest_J, 0.5);
}

/// Turned inside out, the exact Hessian is indefinite: the projected one leads back.
TEST(Newton, RecoversFromInversionByProjecting) {
  const Model model = cube_model("stable_neo_hookean");
  VecX q = model.initial_state().q;
  for (Eigen::Index i = 1; i < q.size(); i += 3) q[i] *= -0.5;  // upside down about its pinned bottom
  ASSERT_LT(smallest_determinant(model, q), 0.0);
  BlockHessian K(model.pattern());
  for (const auto& term : model.energies()) term->add_hessian(q, 1.0, HessianKind::exact, K);
  LinearSolver solver(1);
  solver.analyze(model.pattern(), model.pins());
  ASSERT_EQ(solver.factorize(K), FactorStatus::not_positive_definite);
  for (const char* const linear : {"auto", "cg"}) {
    SolverSettings settings;
    settings.tolerance = 1e-9;
    settings.linear = linear;
    VecX found = q;
    const NewtonReport report = Newton(model, settings).minimize(model, IncrementalPotential{}, found);
    EXPECT_EQ(report.status, StepStatus::converged) << linear;
    EXPECT_GT(smallest_determinant(model, found), 0.0) << linear;
  }
}

TEST(Newton, TellsWhenItsIterationsRunOut) {
  const Model model = cube_model();
  SolverSettings settings;
  settings.max_iterations = 1;
  settings.tolerance = 1e-9;
  VecX q = model.initial_state().q;
  const NewtonReport report =
      Newton(model, settings).minimize(model, step_from_rest(model, 0.1, Vec3(0, 5, 0)), q);
  EXPECT_EQ(report.status, StepStatus::not_converged);
  EXPECT_EQ(report.iterations, 1);
  EXPECT_GT(report.residual, 1e-9);
}

TEST(Newton, TellsWhatIsNotFinite) {
  const Model model = cube_model();
  VecX q = model.initial_state().q;
  q[50] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Newton(model, {}).minimize(model, step_from_rest(model, 0.1, Vec3::Zero()), q).status,
            StepStatus::not_finite);
  q = model.initial_state().q;
  EXPECT_EQ(Newton(model, {}).minimize(model, step_from_rest(model, 0.1, Vec3(0, 1e300, 0)), q).status,
            StepStatus::not_finite);
}

/// A free body has no equilibrium under gravity: V has no minimum and its Hessian is singular.
TEST(Newton, TellsWhenThereIsNoPositiveDefiniteSystem) {
  BodyInput body{cube_mesh(1), {}};
  body.settings.scale = 2.0;
  const Model model({body}, Vec3(0, -9.81, 0));
  VecX q = model.initial_state().q;
  const NewtonReport report = Newton(model, {}).minimize(model, IncrementalPotential{}, q);
  EXPECT_FALSE(is_good(report.status));
}

TEST(Newton, TellsWhichSettingIsOutOfRange) {
  const Model model = cube_model();
  const auto error = [&](auto change) {
    SolverSettings settings;
    change(settings);
    return error_of([&] { Newton(model, settings); });
  };
  using S = SolverSettings;
  EXPECT_EQ(error([](S& s) { s.tolerance = 0.0; }), "solver.tolerance = 0 must be in (0, 1)");
  EXPECT_EQ(error([](S& s) { s.tolerance = 1.0; }), "solver.tolerance = 1 must be in (0, 1)");
  EXPECT_EQ(error([](S& s) { s.tolerance = NAN; }), "solver.tolerance = nan must be in (0, 1)");
  EXPECT_EQ(error([](S& s) { s.max_iterations = 0; }), "solver.max_iterations = 0 must be >= 1");
  EXPECT_EQ(error([](S& s) { s.max_halvings = -1; }), "solver.max_halvings = -1 must be in 0 .. 20");
  EXPECT_EQ(error([](S& s) { s.blas_threads = 0; }), "solver.blas_threads = 0 must be >= 1");
  EXPECT_EQ(error([](S& s) { s.hessian = "exact"; }),
            "unknown solver.hessian 'exact'; valid ones are auto, projected");
  EXPECT_EQ(error([](S& s) { s.linear = "lu"; }),
            "unknown solver.linear 'lu'; valid ones are auto, cholmod, cg");
}

}  // namespace newton_test
}  // namespace lagomorph::sim
