#include "sim/damping.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "sim/kinematics.h"
#include "tests/support/ledger.h"
#include "tests/unit/sim/mesh_fixtures.h"
#include "tests/unit/sim/motion.h"

namespace lagomorph::sim {
namespace damping_test {

class EachDamped : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Damping, EachDamped, testing::ValuesIn(dynamic_integrators()),
                         [](const auto& info) { return info.param; });

/// A free cube of side 1 m, or one held at its top.
Model damped_cube(const DampingSettings& damping, double young = 1e4, bool held = false) {
  BodyInput body{cube_mesh(2), {}};
  body.settings.material.young = young;
  body.settings.damping = damping;
  if (held) body.settings.pin.emplace_back().top = 0.1;
  return Model({body}, Vec3::Zero());
}

Eigen::MatrixXd damping_matrix(const Model& model, const VecX& q) {
  BlockHessian C(model.pattern());
  model.damping().assemble(model.energies(), q, C);
  return Eigen::MatrixXd(C.to_sparse());
}

VecX turned(const VecX& q, const Vec3& axis, double angle) {
  const Mat3 R = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  VecX x = q;
  for (Eigen::Index i = 0; i < q.size(); i += 3) x.segment<3>(i) = R * q.segment<3>(i);
  return x;
}

/// Some shape that is neither the rest shape nor small.
VecX deformed(const Model& model) {
  VecX q = model.initial_state().q;
  for (Eigen::Index i = 0; i < q.size(); i += 3)
    q.segment<3>(i) += Vec3(0.3 * q[i + 1], 0.2 * q[i] * q[i + 2], -0.1 * q[i + 2] * q[i + 2]);
  return turned(q, Vec3(1, 2, 3), 1.0);
}

// --- C -----------------------------------------------------------------------------------------------------

TEST(Damping, IsTheSumOfItsParts) {
  const Model none = damped_cube({});
  EXPECT_TRUE(none.damping().is_none());
  const Model model = damped_cube({.mass = 0.5, .stiffness = 0.25, .viscosity = 0.0});
  const VecX q = deformed(model);
  BlockHessian K(model.pattern());
  for (const auto& term : model.energies()) term->add_hessian(q, 1.0, HessianKind::projected, K);
  const Eigen::MatrixXd expected =
      0.5 * Eigen::MatrixXd(model.mass()) + 0.25 * Eigen::MatrixXd(K.to_sparse());
  EXPECT_LT((damping_matrix(model, q) - expected).norm(), 1e-12 * expected.norm());
}

TEST(Damping, IsOfEachBodyItsOwn) {
  BodyInput one{one_tet(), {}}, two{one_tet(), {}};
  two.settings.translate = Vec3(5, 0, 0);
  two.settings.name = "two";
  two.settings.damping = {.mass = 3.0, .stiffness = 0.0, .viscosity = 2.0};
  const Model model({one, two}, Vec3::Zero());
  const Eigen::MatrixXd C = damping_matrix(model, model.initial_state().q);
  EXPECT_EQ(C.topRows(12).norm(), 0.0);
  EXPECT_GT(C.bottomRightCorner(12, 12).norm(), 0.0);
  EXPECT_EQ(C.bottomLeftCorner(12, 12).norm(), 0.0);
}

/// The power 2 η |sym(FᵀḞ)|² of each element, by the slow way.
TEST(Viscosity, DissipatesByTheStrainRate) {
  const Model model = damped_cube({.mass = 0.0, .stiffness = 0.0, .viscosity = 7.0});
  const VecX q = deformed(model);
  VecX qdot(q.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) qdot[i] = std::sin(3.0 * static_cast<double>(i) + 1.0);
  double power = 0.0;
  const VecX X = model.initial_state().q;
  for (const Tet& tet : model.mesh().tets) {
    const TetCorners rest = gather_corners(X, tet);
    const ShapeGradients D = dphi_dX(rest);
    const Mat3 F = deformation_gradient(gather_corners(q, tet), D),
               Fdot = deformation_gradient(gather_corners(qdot, tet), D);
    const Mat3 Edot = 0.5 * (F.transpose() * Fdot + Fdot.transpose() * F);
    power += tet_volume(rest) * 2.0 * 7.0 * Edot.squaredNorm();
  }
  const Eigen::MatrixXd C = damping_matrix(model, q);
  EXPECT_NEAR(qdot.dot(C * qdot), power, 1e-12 * power);
  EXPECT_LT((C - C.transpose()).norm(), 1e-14 * C.norm());
}

/// At any shape, all six rigid velocities and nothing else.
TEST(Viscosity, LeavesRigidVelocitiesAlone) {
  const Model model = damped_cube({.mass = 0.0, .stiffness = 0.0, .viscosity = 7.0});
  const VecX q = deformed(model);
  const Eigen::MatrixXd C = damping_matrix(model, q);
  for (int k = 0; k < 6; ++k) {
    VecX qdot(q.size());
    const Vec3 axis = Vec3::Unit(k % 3);
    for (Eigen::Index i = 0; i < q.size(); i += 3)
      qdot.segment<3>(i) = k < 3 ? axis : axis.cross(Vec3(q.segment<3>(i)));
    EXPECT_LT((C * qdot).norm(), 1e-13 * C.norm() * qdot.norm()) << k;
  }
  const VecX eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(C).eigenvalues();
  EXPECT_GT(eigenvalues[0], -1e-12 * eigenvalues[eigenvalues.size() - 1]);
  EXPECT_LT(eigenvalues[5], 1e-12 * eigenvalues[eigenvalues.size() - 1]);
  EXPECT_GT(eigenvalues[6], 1e-4 * eigenvalues[eigenvalues.size() - 1]);
}

TEST(Damping, TellsWhatIsWrong) {
  EXPECT_EQ(error_of([] { damped_cube({.mass = -1.0, .stiffness = 0.0, .viscosity = 0.0}); }),
            "body 'body0': damping.mass = -1 must be >= 0 1/s");
  EXPECT_EQ(error_of([] { damped_cube({.mass = 0.0, .stiffness = 0.0, .viscosity = INFINITY}); }),
            "body 'body0': damping.viscosity = inf must be >= 0 Pa s");
}

// --- Decay of a mode in closed form ------------------------------------------------------------------------

/// The softest mode of the held cube: its frequency, shape and the rate δ/2 = uᵀCu/2 at which it decays.
struct Mode {
  double omega = 0.0, rate = 0.0;
  VecX shape;  // with uᵀMu = 1
};
Mode softest_mode(const Model& model) {
  const VecX X = model.initial_state().q;
  BlockHessian K(model.pattern());
  for (const auto& term : model.energies()) term->add_hessian(X, 1.0, HessianKind::exact, K);
  const SparseMatrix P = model.pins().matrix(), Pt = P.transpose();
  const Eigen::MatrixXd K_free = P * K.to_sparse() * Pt, M_free = P * model.mass() * Pt;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(K_free, M_free);
  Mode mode{std::sqrt(modes.eigenvalues()[0]), 0.0, Pt * VecX(modes.eigenvectors().col(0))};
  mode.rate = 0.5 * mode.shape.dot(damping_matrix(model, X) * mode.shape);
  return mode;
}

/// Amplitude of x'' + 2 δ x' + ω² x = 0 from (1, 0) on: x, x'.
Eigen::Vector2d oscillation(double omega, double delta, double t) {
  const double w = std::sqrt(omega * omega - delta * delta), decay = std::exp(-delta * t);
  return {decay * (std::cos(w * t) + delta / w * std::sin(w * t)),
          -decay * omega * omega / w * std::sin(w * t)};
}

struct DecayCase {
  const char* name;
  DampingSettings damping;
};
class Decay : public testing::TestWithParam<DecayCase> {};
INSTANTIATE_TEST_SUITE_P(Damping, Decay,
                         testing::Values(DecayCase{"mass", {1.5, 0.0, 0.0}},
                                         DecayCase{"stiffness", {0.0, 0.04, 0.0}},
                                         DecayCase{"viscosity", {0.0, 0.0, 150.0}},
                                         DecayCase{"all", {0.5, 0.02, 50.0}}),
                         [](const auto& info) { return std::string(info.param.name); });

/// A small swing in one mode decays as e^{-δt} with δ = (α + β ω²)/2 of Rayleigh's two, and with that of the
/// mode's own strain rate of viscosity; two periods later what is left is the closed form's, by each scheme
/// with its order.
TEST_P(Decay, IsThatOfTheDampedOscillator) {
  const DampingSettings& damping = GetParam().damping;
  const Model model = damped_cube(damping, 1e4, true);
  const Mode mode = softest_mode(model);
  if (damping.viscosity == 0.0) {
    EXPECT_NEAR(mode.rate, 0.5 * (damping.mass + damping.stiffness * mode.omega * mode.omega),
                1e-10 * mode.rate);
  }
  const double end = 4.0 * M_PI / mode.omega;
  ASSERT_GT(mode.rate * end, 0.5);  // a good part of it is lost
  const Eigen::Vector2d exact = oscillation(mode.omega, mode.rate, end);
  for (const std::string& name : dynamic_integrators()) {
    const bool second = name == "bdf2" || name == "implicit_midpoint" || name == "trapezoidal";
    if (name == "symplectic_euler") continue;  // at its stable step; see below
    std::vector<double> errors;
    for (const int steps : {300, 600}) {
      Motion run(damped_cube(damping, 1e4, true), name, steps / end, 1e-9);
      const VecX X = run.state.q;
      const double a = 1e-5;  // small enough to be linear
      run.state.q += a * mode.shape;
      run.advance(steps);
      const Eigen::Vector2d end_of_run(mode.shape.dot(run.model.mass_times(run.state.q - X)) / a,
                                       mode.shape.dot(run.model.mass_times(run.state.qdot)) / a);
      errors.push_back((end_of_run - exact).cwiseQuotient(Eigen::Vector2d(1.0, mode.omega)).norm());
    }
    EXPECT_LT(errors[1], second ? 2e-3 : 0.12) << name;
    if (damping.viscosity > 0.0 && second) continue;  // it couples modes a little: no closed form is exact
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), second ? 2.0 : 1.0, 0.15)
        << name << " " << errors[0] << " " << errors[1] << " of " << exact[0];
  }
}

/// The order of each scheme on the reference cube with large motion and all three kinds of damping, by
/// halving the step twice.
TEST_P(EachDamped, KeepsItsOrderWithDamping) {
  const auto end_of = [&](int steps) {
    Motion run(reference_cube("snh", {.mass = 0.5, .stiffness = 0.005, .viscosity = 100.0}), GetParam(),
               2.0 * steps, 1e-10);
    for (const auto& row : truth::csv("4b_cube_order/v0.csv"))
      run.state.qdot.segment<3>(3 * static_cast<int>(row[0])) = Vec3(row[1], row[2], row[3]);
    run.advance(steps);
    return run.state.q;
  };
  const bool second =
      GetParam() == "bdf2" || GetParam() == "implicit_midpoint" || GetParam() == "trapezoidal";
  const VecX a = end_of(240), b = end_of(480), c = end_of(960);
  EXPECT_NEAR(std::log2((a - b).norm() / (b - c).norm()), second ? 2.0 : 1.0, 0.1);
}

// --- Energy and momentum -----------------------------------------------------------------------------------

/// T + V + loss is kept up to h² by the midpoint rule, and the loss is a good part of what there was.
TEST(ImplicitMidpoint, BalancesEnergyAndLoss) {
  std::vector<double> drifts;
  for (const double fps : {100.0, 200.0}) {
    Motion run(reference_cube("snh", {.mass = 0.5, .stiffness = 0.005, .viscosity = 100.0}),
               "implicit_midpoint", fps, 1e-12);
    const double before = run.model.energies_of(run.state).total();
    double lost = 0.0;
    for (int k = 0; k < fps; ++k) {
      const FrameReport report = run.advance();
      ASSERT_TRUE(is_good(report.status)) << report.reason;
      EXPECT_GE(report.damping_loss, 0.0);
      lost += report.damping_loss;
    }
    EXPECT_GT(lost, 20.0);
    drifts.push_back(std::abs(run.model.energies_of(run.state).total() + lost - before) / lost);
  }
  EXPECT_LT(drifts[1], 1e-3);
  EXPECT_NEAR(drifts[0] / drifts[1], 4.0, 1.0) << drifts[0] << " " << drifts[1];
}

TEST_P(EachDamped, NeverGainsByDamping) {
  Motion run(reference_cube("snh", {.mass = 0.5, .stiffness = 0.01, .viscosity = 200.0}), GetParam(), 60);
  double total = run.model.energies_of(run.state).total();
  for (int k = 0; k < 60; ++k) {
    const FrameReport report = run.advance();
    ASSERT_TRUE(is_good(report.status)) << report.reason;
    EXPECT_GE(report.damping_loss, 0.0);
    const double now = run.model.energies_of(run.state).total();
    EXPECT_LT(now, total + 1e-3 * report.damping_loss + 1e-9);
    total = now;
  }
}

/// A free body that turns loses what its swing into the centrifugal stretch has, and then nothing more: over
/// the third second the rounding of a few steps, while Rayleigh's mass damping stops it.
TEST(Viscosity, LeavesFreeRotationAlone) {
  const auto losses_of = [](const DampingSettings& damping) {
    Motion run(damped_cube(damping, 1e6), "implicit_midpoint", 200.0, 1e-12);
    const Vec3 centre(0.5, 0.5, 0.5), omega(0, 0, 2);
    for (Eigen::Index i = 0; i < run.state.q.size(); i += 3)
      run.state.qdot.segment<3>(i) = omega.cross(Vec3(Vec3(run.state.q.segment<3>(i)) - centre));
    const double before = run.model.energies_of(run.state).kinetic;
    Vec3 lost = Vec3::Zero();  // in each second, of what there was
    for (int k = 0; k < 600; ++k) lost[k / 200] += run.advance().damping_loss / before;
    return lost;
  };
  const Vec3 viscous = losses_of({.mass = 0.0, .stiffness = 0.0, .viscosity = 2000.0});
  tell("viscosity", {"second of free rotation", "loss by viscosity / kinetic energy at the start"},
       {"1", told(viscous[0])});
  tell("viscosity", {}, {"3", told(viscous[2])});
  EXPECT_LT(viscous[0], 1e-3);
  EXPECT_LT(viscous[2], 1e-9) << viscous.transpose();
  EXPECT_GT(losses_of({.mass = 0.5, .stiffness = 0.0, .viscosity = 0.0})[0], 0.5);
}

/// Viscosity and stiffness damping are inner forces: they keep momentum; the midpoint rule's viscosity nearly
/// the angular momentum too.
TEST_P(EachDamped, DampsWithoutChangingMomentum) {
  Motion run(damped_cube({.mass = 0.0, .stiffness = 0.01, .viscosity = 100.0}), GetParam(), 60);
  for (Eigen::Index i = 0; i < run.state.q.size(); i += 3)
    run.state.qdot.segment<3>(i) = Vec3(1.0 + run.state.q[i + 1], -0.5 * run.state.q[i], 0.25);
  const Vec3 before = run.model.momentum(run.state);
  double lost = 0.0;
  for (int k = 0; k < 30; ++k) lost += run.advance().damping_loss;
  EXPECT_GT(lost, 0.0);
  EXPECT_LT((run.model.momentum(run.state) - before).norm(), 1e-8 * before.norm());
}

/// The largest stable step of the damped body: an eighth above it energy grows without bound.
TEST(SymplecticEuler, TakesDampingIntoItsStableStep) {
  const DampingSettings damping = {.mass = 1.0, .stiffness = 0.02, .viscosity = 0.0};
  Motion run(damped_cube(damping, 1e4, true), "symplectic_euler", 1.0);
  const VecX X = run.state.q;
  BlockHessian K(run.model.pattern());
  for (const auto& term : run.model.energies()) term->add_hessian(X, 1.0, HessianKind::exact, K);
  const SparseMatrix P = run.model.pins().matrix(), Pt = P.transpose();
  const Eigen::MatrixXd K_free = P * K.to_sparse() * Pt, M_free = P * run.model.mass() * Pt;
  const double omega = std::sqrt(
      Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(K_free, M_free).eigenvalues().maxCoeff());
  const double zeta = 0.5 * (1.0 / omega + 0.02 * omega);
  const double stable = 2.0 / omega * (std::sqrt(1.0 + zeta * zeta) - zeta);
  EXPECT_LT(stable, 0.7 * 2.0 / omega);
  State state = run.state;
  state.q += 1e-6 * Pt * VecX::Ones(P.rows());
  const StepReport report = run.integrator->step(run.model, state, 20.0 * stable);
  EXPECT_EQ(report.status, StepStatus::converged);
  EXPECT_GE(report.steps, 22);
  EXPECT_LE(report.steps, 25);
  run.state.q += 1e-6 * Pt * VecX::Ones(P.rows());
  run.advance(1);
  EXPECT_LT((run.state.q - X).norm(), 1e-5);
}

TEST_P(EachDamped, TakesDampingToTheSameBytesFromAState) {
  const DampingSettings damping = {.mass = 0.5, .stiffness = 0.005, .viscosity = 100.0};
  Motion whole(damped_cube(damping, 1e4, true), GetParam(), 30.0, 1e-6);
  whole.state.qdot.setConstant(0.5);
  whole.model.pins().clear_pinned(whole.state.qdot);
  whole.advance(2);
  Motion resumed(damped_cube(damping, 1e4, true), GetParam(), 30.0, 1e-6);
  resumed.state = whole.state;
  whole.advance(2);
  resumed.advance(2);
  EXPECT_EQ(resumed.state.q, whole.state.q);
  EXPECT_EQ(resumed.state.qdot, whole.state.qdot);
}

}  // namespace damping_test
}  // namespace lagomorph::sim
