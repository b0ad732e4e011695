#include "sim/integrator.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "sim/parallel.h"
#include "tests/support/ledger.h"
#include "tests/support/paths.h"
#include "tests/support/truth.h"
#include "tests/unit/sim/mesh_fixtures.h"
#include "tests/unit/sim/motion.h"

namespace lagomorph::sim {
namespace integrator_test {

// --- The reference bar -------------------------------------------------------------------------------------

struct BarCase {
  const char* name;  // of the truth's files
  const char* integrator;
  const char* model;
  double fps;
  const char* hessian = "auto";
};

class Bar : public testing::TestWithParam<BarCase> {};

TEST_P(Bar, MeetsTheReferenceForFiftySteps) {
  const BarCase& c = GetParam();
  Motion run(truth::bar(c.model, 1e6, kGravity), c.integrator, c.fps);
  run.solver.hessian = c.hessian;
  run.integrator = make_integrator(run.time, run.solver, run.model);
  const std::string base = std::string("4_bar_dynamic/") + c.name;
  const auto rows = truth::csv(base + ".csv");
  ASSERT_EQ(rows.size(), 51u);
  const bool has_positions = std::filesystem::exists(truth::path(base + "_positions.npy"));
  const auto positions = has_positions ? truth::npy(base + "_positions.npy") : std::vector<double>();
  Vec3 largest = Vec3::Zero();  // of each energy
  for (const auto& row : rows)
    for (int k = 0; k < 3; ++k)
      largest[k] = std::max(largest[k], std::abs(row[2 + static_cast<std::size_t>(k)]));
  double worst = 0.0, worst_energy = 0.0;  // of the tip, or of all positions where there are; of a total
  for (std::size_t frame = 0; frame <= 50; ++frame) {
    if (frame > 0) run.advance(1);
    if (HasFatalFailure()) return;
    const auto& row = rows[frame];
    const Energies energies = run.model.energies_of(run.state);
    worst_energy = std::max(worst_energy, std::abs(energies.elastic - row[3]) / largest[1]);
    EXPECT_NEAR(energies.kinetic, row[2], 1e-8 * largest[0]);
    EXPECT_NEAR(energies.elastic, row[3], 1e-8 * largest[1]);
    EXPECT_NEAR(energies.gravitational, row[4], 1e-8 * largest[2]);
    const Vec3 momentum = run.model.momentum(run.state);
    for (int k = 0; k < 3; ++k) {
      worst = std::max(worst, std::abs(run.state.q[3 * 6 + k] - row[6 + static_cast<std::size_t>(k)]));
      EXPECT_NEAR(run.state.q[3 * 6 + k], row[6 + static_cast<std::size_t>(k)], 1e-8);  // the tip
      EXPECT_NEAR(momentum[k], row[15 + static_cast<std::size_t>(k)], 1e-7);
    }
    if (!has_positions) continue;
    const Eigen::Map<const VecX> expected(
        positions.data() + static_cast<std::ptrdiff_t>(frame) * run.state.q.size(), run.state.q.size());
    worst = std::max(worst, (run.state.q - expected).cwiseAbs().maxCoeff());
    EXPECT_LT((run.state.q - expected).cwiseAbs().maxCoeff(), 1e-8);
  }
  tell("dynamic", {"50 steps of", "largest error of a position [m]", "of the elastic energy / its largest"},
       {c.name, told(worst), told(worst_energy)});
}

class BarEnd : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(BarEnd, IsAtTheReferencePositionsAndVelocities) {
  const auto& [integrator, file] = GetParam();
  Motion run(truth::bar("nh_lecture", 1e6, kGravity), integrator, 60);
  run.advance(50);
  const auto rows = truth::csv(std::string("4_bar_dynamic/") + file);
  ASSERT_EQ(rows.size(), 399u);
  for (const auto& row : rows) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(run.state.q[3 * static_cast<int>(row[0]) + static_cast<int>(k)], row[1 + k], 1e-8);
      EXPECT_NEAR(run.state.qdot[3 * static_cast<int>(row[0]) + static_cast<int>(k)], row[4 + k], 1e-6);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Integrators, BarEnd,
                         testing::Values(std::pair("linearly_implicit_euler",
                                                   "linearly_implicit_dt60_nh_lecture_final.csv"),
                                         std::pair("bdf2", "bdf2_dt60_nh_lecture_final.csv")),
                         [](const auto& info) { return std::string(info.param.first); });

INSTANTIATE_TEST_SUITE_P(
    Integrators, Bar,
    testing::Values(BarCase{"be_dt60_nh_lecture", "backward_euler", "nh_lecture", 60},
                    BarCase{"be_dt60_snh", "backward_euler", "snh", 60},
                    BarCase{"be_dt1e-3_nh_lecture", "backward_euler", "nh_lecture", 1000},
                    BarCase{"bdf2_dt60_nh_lecture", "bdf2", "nh_lecture", 60},
                    BarCase{"linearly_implicit_dt60_nh_lecture", "linearly_implicit_euler", "nh_lecture", 60},
                    BarCase{"linearly_implicit_psd9_dt60_nh_lecture", "linearly_implicit_euler", "nh_lecture",
                            60, "projected"}),
    [](const auto& info) {
      std::string name = info.param.name;
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

// --- The reference cube: orders of convergence
// ---------------------------------------------------------------

/// The cube after `steps` steps to t = 0.5 from the reference's initial velocity.
State cube_at_half_a_second(const char* truth_model, const std::string& integrator, int steps) {
  Motion run(reference_cube(truth_model), integrator, 2.0 * steps, 1e-10);
  for (const auto& row : truth::csv("4b_cube_order/v0.csv"))
    run.state.qdot.segment<3>(3 * static_cast<int>(row[0])) = Vec3(row[1], row[2], row[3]);
  run.advance(steps);
  return run.state;
}

/// Largest difference in positions, or in velocities, to a file of rows vertex, x, y, z, vx, vy, vz.
struct Difference {
  double q = 0.0, qdot = 0.0;
};
Difference difference(const State& state, const std::string& file) {
  Difference worst;
  for (const auto& row : truth::csv(file)) {
    const int v = 3 * static_cast<int>(row[0]);
    const Vec3 x(row[1], row[2], row[3]), xdot(row[4], row[5], row[6]);
    worst.q = std::max(worst.q, (state.q.segment<3>(v) - x).cwiseAbs().maxCoeff());
    worst.qdot = std::max(worst.qdot, (state.qdot.segment<3>(v) - xdot).cwiseAbs().maxCoeff());
  }
  return worst;
}

TEST(BackwardEuler, MeetsTheReferenceCube) {
  const Difference from_reference = difference(cube_at_half_a_second("nh_lecture", "backward_euler", 30),
                                               "4b_cube_order/be_N30_nh_lecture.csv");
  EXPECT_LT(from_reference.q, 1e-9);
  EXPECT_LT(from_reference.qdot, 1e-8);
}

TEST(Bdf2, MeetsTheReferenceCube) {
  const Difference from_reference =
      difference(cube_at_half_a_second("nh_lecture", "bdf2", 30), "4b_cube_order/bdf2_N30_nh_lecture.csv");
  EXPECT_LT(from_reference.q, 1e-9);
  EXPECT_LT(from_reference.qdot, 1e-8);
}

/// The path goes to the exact solution of M q̈ = -∂V/∂q as the step goes to zero, each scheme with its order;
/// the reference's own figures at these steps.
struct Order {
  const char* integrator;
  double order;
  double largest;  // difference at 960 steps [m]
};
class Convergence : public testing::TestWithParam<Order> {};
INSTANTIATE_TEST_SUITE_P(Integrators, Convergence,
                         testing::Values(Order{"backward_euler", 0.965, 3e-3},
                                         Order{"linearly_implicit_euler", 0.965, 3e-3},
                                         Order{"bdf2", 1.994, 1e-4}, Order{"implicit_midpoint", 1.9995, 1e-4},
                                         Order{"trapezoidal", 1.9995, 1e-4},
                                         Order{"symplectic_euler", 1.005, 3e-3}),
                         [](const auto& info) { return std::string(info.param.integrator); });

TEST_P(Convergence, HasItsOrder) {
  const Order& expected = GetParam();
  for (const char* model : {"nh_lecture", "snh"}) {
    const std::string exact = std::string("4b_cube_order/exact_t0.5_") + model + ".csv";
    const double coarse = difference(cube_at_half_a_second(model, expected.integrator, 480), exact).q;
    const double fine = difference(cube_at_half_a_second(model, expected.integrator, 960), exact).q;
    tell("time_order", {"integrator", "model", "error after 480 steps [m]", "after 960", "order"},
         {expected.integrator, truth::model_name(model), told(coarse), told(fine),
          told(std::log2(coarse / fine))});
    EXPECT_NEAR(std::log2(coarse / fine), expected.order, 0.03) << model << " " << coarse << " " << fine;
    EXPECT_LT(fine, expected.largest) << model;
  }
}

/// Each step fulfils M (q_k+1 - 2 q_k + q_k-1)/h² = -∂V/∂q(q_k+1), the equations of motion with backward
/// differences.
TEST(BackwardEuler, FulfilsTheDiscreteEquationsOfMotion) {
  Motion run(reference_cube("snh"), "backward_euler", 60);
  const double h = 1.0 / 60.0;
  const SparseMatrix M = run.model.mass();
  run.advance(1);
  VecX q_before = run.model.initial_state().q;
  for (int k = 0; k < 20; ++k) {
    const VecX q = run.state.q;
    run.advance(1);
    VecX residual = M * (run.state.q - 2.0 * q + q_before) / (h * h);
    for (const auto& term : run.model.energies()) term->add_gradient(run.state.q, 1.0, residual);
    EXPECT_LT(run.model.pins().free_norm(residual),
              1e-10 * run.model.pins().free_norm(run.model.gravity_force()));
    q_before = q;
  }
}

// --- Motions in closed form
// ----------------------------------------------------------------------------------

class Each : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Integrators, Each, testing::ValuesIn(dynamic_integrators()),
                         [](const auto& info) { return info.param; });

Model free_cube(const Vec3& gravity, const Vec3& velocity, const std::string& mass = "consistent") {
  BodyInput body{cube_mesh(2), {}};
  body.settings.velocity = velocity;
  body.settings.mass = mass;
  return Model({body}, gravity);
}

/// What a scheme makes of x'' = g: the same recursion on numbers.
struct Fall {
  Vec3 x = Vec3::Zero(), v;
};
Fall fall(const std::string& integrator, Vec3 v, double h, int steps) {
  Fall now{Vec3::Zero(), v}, before = now;
  for (int k = 0; k < steps; ++k) {
    Fall next;
    if (integrator == "bdf2" && k > 0) {
      next.v = (4.0 * now.v - before.v) / 3.0 + 2.0 / 3.0 * h * kGravity;
      next.x = (4.0 * now.x - before.x) / 3.0 + 2.0 / 3.0 * h * next.v;
    } else {
      next.v = now.v + h * kGravity;
      const bool is_mean = integrator == "implicit_midpoint" || integrator == "trapezoidal";
      next.x = now.x + h * (is_mean ? Vec3(0.5 * (now.v + next.v)) : next.v);
    }
    before = now;
    now = next;
  }
  return now;
}

/// A fall is that of a point in the scheme's own discrete sense, for the two means the parabola itself, and
/// nothing is deformed.
TEST_P(Each, LetsAFreeBodyFall) {
  for (const char* mass : {"consistent", "lumped"}) {
    Motion run(free_cube(kGravity, Vec3(1, 2, 3), mass), GetParam(), 50);
    run.solver.tolerance = 1e-11;
    const Vec3 momentum = run.model.momentum(run.state);
    const FrameReport first = run.advance();  // an explicit scheme may divide it
    run.advance(24);
    const double h = 1.0 / (50.0 * first.steps);
    const Fall end = fall(GetParam(), Vec3(1, 2, 3), h, 25 * first.steps);
    const VecX rest = run.model.initial_state().q;
    for (int i = 0; i < 27; ++i) {
      EXPECT_LT((run.state.qdot.segment<3>(3 * i) - end.v).norm(), 1e-8);
      EXPECT_LT((run.state.q.segment<3>(3 * i) - rest.segment<3>(3 * i) - end.x).norm(), 1e-9);
    }
    const Vec3 gained = run.model.momentum(run.state) - momentum;
    EXPECT_LT((gained - 0.5 * run.model.total_mass() * kGravity).norm(), 1e-8 * gained.norm());
    EXPECT_NEAR(run.model.energies_of(run.state).elastic, 0.0, 1e-9);
    if (GetParam() == "implicit_midpoint" || GetParam() == "trapezoidal") {
      EXPECT_LT((end.x - (0.5 * Vec3(1, 2, 3) + 0.125 * kGravity)).norm(), 1e-12);
    }
  }
}

TEST_P(Each, KeepsTheMomentumOfAFreeBody) {
  Motion run(free_cube(Vec3::Zero(), Vec3::Zero()), GetParam(), 30);
  for (int v = 0; v < 27; ++v)
    run.state.qdot[3 * v] = 2.0 * run.model.mesh().X(v, 1) - 0.3;  // shears and turns it
  const Vec3 before = run.model.momentum(run.state);
  run.advance(30);
  const double change = (run.model.momentum(run.state) - before).norm() / before.norm();
  EXPECT_LT(change, 1e-7);
  EXPECT_GT(run.model.energies_of(run.state).elastic, 0.0);
  tell("momentum", {"integrator", "change of momentum in 30 steps / momentum"}, {GetParam(), told(change)});
}

TEST_P(Each, LeavesARestingBodyAlone) {
  Motion run(free_cube(Vec3::Zero(), Vec3::Zero()), GetParam(), 30);
  run.advance(5);
  EXPECT_LT((run.state.q - run.model.initial_state().q).cwiseAbs().maxCoeff(), 1e-14);
}

TEST_P(Each, HoldsPinsExactly) {
  Motion run(truth::bar("snh", 1e6, kGravity), GetParam(), 60, 1e-6);
  run.advance(5);
  const VecX rest = run.model.initial_state().q;
  ASSERT_EQ(run.model.pins().vertices().size(), 31u);
  for (const int v : run.model.pins().vertices()) {
    EXPECT_EQ(Vec3(run.state.q.segment<3>(3 * v)), Vec3(rest.segment<3>(3 * v)));
    EXPECT_EQ(Vec3(run.state.qdot.segment<3>(3 * v)), Vec3::Zero());
  }
}

TEST_P(Each, MayHaveAllPinned) {
  BodyInput body{cube_mesh(2), {}};
  body.settings.pin.emplace_back().top = 1.0;
  Motion run(Model({body}, kGravity), GetParam(), 30);
  run.advance(3);
  EXPECT_EQ(run.state.q, run.model.initial_state().q);
  EXPECT_EQ(run.state.frame, 3);
}

/// With fixed pins, backward Euler's total energy never rises.
TEST(BackwardEuler, LosesEnergyOnly) {
  for (const char* model : {"nh_lecture", "snh", "snh_log"}) {
    Motion run(truth::bar(model, 1e5, kGravity), "backward_euler", 30, 1e-6);
    double lowest = 0.0, largest_rise = 0.0, before = run.model.energies_of(run.state).total();
    const double first = before;
    for (int k = 0; k < 45; ++k) {
      run.advance(1);
      if (HasFatalFailure()) return;
      const double total = run.model.energies_of(run.state).total();
      largest_rise = std::max(largest_rise, total - before);
      lowest = std::min(lowest, total);
      before = total;
    }
    EXPECT_LT(largest_rise, 1e-6 * (first - lowest)) << model;
  }
}

/// Σ x × M q̇ about the origin. [kg m²/s]
Vec3 angular_momentum(const Motion& run) {
  const VecX p = run.model.mass_times(run.state.qdot);
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index i = 0; i < p.size(); i += 3) {
    const Vec3 x = run.state.q.segment<3>(i), p_i = p.segment<3>(i);
    sum += x.cross(p_i);
  }
  return sum;
}

/// A stretched cube that turns, free and without gravity, over some seconds.
Motion turning_cube(const std::string& integrator) {
  Motion run(free_cube(Vec3::Zero(), Vec3::Zero()), integrator, 60, 1e-12);
  for (Eigen::Index i = 0; i < run.state.q.size(); i += 3) {
    const Vec3 x = run.state.q.segment<3>(i);
    run.state.q.segment<3>(i) = Vec3(1.15 * x.x(), x.y(), x.z());
    run.state.qdot.segment<3>(i) = Vec3(0, 0, 4).cross(Vec3(x - Vec3(0.5, 0.5, 0.5)));
  }
  return run;
}

/// The symplectic schemes whose discrete Lagrangian is invariant under rotations keep angular momentum to
/// rounding; backward Euler and BDF2 lose some of it.
TEST_P(Each, KeepsAngularMomentumWhereItsSchemeDoes) {
  Motion run = turning_cube(GetParam());
  const Vec3 before = angular_momentum(run);
  run.advance(120);
  const double change = (angular_momentum(run) - before).norm() / before.norm();
  RecordProperty("relative_change", std::to_string(change));
  if (GetParam() == "implicit_midpoint" || GetParam() == "symplectic_euler") {
    EXPECT_LT(change, 1e-8);
  } else if (GetParam() != "trapezoidal") {
    EXPECT_GT(change, 1e-5);
  }
}

/// Energy of the same: lost by the dissipative schemes; by the symplectic ones, and the trapezoidal rule that
/// is conjugate to one, kept within a band without drift (of symplectic Euler wide, since its q̇ is half a
/// step behind).
TEST_P(Each, HasItsEnergyBehaviour) {
  Motion run = turning_cube(GetParam());
  const Vec3 spin = angular_momentum(run);
  std::vector<double> totals = {run.model.energies_of(run.state).total()};
  for (int k = 0; k < 240; ++k) {
    run.advance(1);
    totals.push_back(run.model.energies_of(run.state).total());
  }
  const double before = totals.front();
  const auto [low, high] = std::minmax_element(totals.begin(), totals.end());
  const double band = (*high - *low) / before, lost = (before - totals.back()) / before;
  const double drift = (std::accumulate(totals.end() - 120, totals.end(), 0.0) -
                        std::accumulate(totals.begin(), totals.begin() + 120, 0.0)) /
                       (120.0 * before);
  tell("spin",
       {"integrator", "change of angular momentum in 240 steps", "width of the energy's band", "its drift",
        "lost"},
       {GetParam(), told((angular_momentum(run) - spin).norm() / spin.norm()), told(band), told(drift),
        told(lost)});
  RecordProperty("band", std::to_string(band));
  RecordProperty("drift", std::to_string(drift));
  const std::string name = GetParam();
  if (name == "implicit_midpoint" || name == "trapezoidal" || name == "symplectic_euler") {
    EXPECT_LT(band, name == "symplectic_euler" ? 0.2 : 0.06);
    EXPECT_LT(std::abs(drift), 0.02);
  } else {
    EXPECT_GT(lost, 0.02);
    EXPECT_LT(*high, before * (1.0 + 1e-9));
  }
}

/// Far above its stable step symplectic Euler divides the step instead of blowing up.
TEST(SymplecticEuler, DividesWhatIsNotStable) {
  Motion run(truth::bar("snh", 1e6, kGravity), "symplectic_euler", 10.0);
  const double before = run.model.energies_of(run.state).total();
  const FrameReport report = run.advance();
  EXPECT_GT(report.steps, 100);
  EXPECT_EQ(report.newton_iterations, 0);
  const Energies after = run.model.energies_of(run.state);
  EXPECT_NEAR(after.total(), before, 0.02 * (after.kinetic + after.elastic));
}

/// The stable step is that of the largest ω: a little above it, energy grows without bound.
TEST(SymplecticEuler, TakesNearlyTheStableStep) {
  Motion run(reference_cube("snh"), "symplectic_euler", 1.0);
  BlockHessian K(run.model.pattern());
  K.set_zero();
  for (const auto& term : run.model.energies()) term->add_hessian(run.state.q, 1.0, HessianKind::exact, K);
  const SparseMatrix P = run.model.pins().matrix();
  const Eigen::MatrixXd K_free = P * K.to_sparse() * SparseMatrix(P.transpose());
  const Eigen::MatrixXd M_free = P * run.model.mass() * SparseMatrix(P.transpose());
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(K_free, M_free);
  const double stable = 2.0 / std::sqrt(modes.eigenvalues().maxCoeff());
  State state = run.state;
  const StepReport report = run.integrator->step(run.model, state, 20.0 * stable);
  EXPECT_EQ(report.status, StepStatus::converged);
  EXPECT_GE(report.steps, 22);
  EXPECT_LE(report.steps, 25);
}

/// After a change of the step BDF2 begins anew with backward Euler.
TEST(Bdf2, BeginsAnewAfterAChangeOfStep) {
  Motion bdf2(reference_cube("snh"), "bdf2", 60);
  bdf2.advance(4);
  Motion euler(reference_cube("snh"), "backward_euler", 60);
  euler.state = bdf2.state;
  euler.state.history.clear();
  State a = bdf2.state, b = euler.state, c = bdf2.state;
  bdf2.integrator->step(bdf2.model, a, 1.0 / 240);
  euler.integrator->step(euler.model, b, 1.0 / 240);
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(a.qdot, b.qdot);
  EXPECT_EQ(a.history.front().q, bdf2.state.q);
  bdf2.integrator->step(bdf2.model, c, 1.0 / 60);
  euler.integrator->step(euler.model, euler.state, 1.0 / 60);
  EXPECT_NE(c.q, euler.state.q);
}

// --- Frames
// ----------------------------------------------------------------------------------------------------

TEST_P(Each, ArrivesAtFramesExactly) {
  Motion run(free_cube(kGravity, Vec3::Zero()), GetParam(), 24.0);
  run.time.substeps = 3;
  for (int k = 1; k <= 50; ++k) {
    const FrameReport report = run.advance();
    EXPECT_EQ(report.steps % 3, 0);  // an explicit scheme may divide each
    if (GetParam() != "symplectic_euler") {
      EXPECT_EQ(report.steps, 3);
    }
    EXPECT_EQ(run.state.frame, k);
    EXPECT_EQ(run.state.t, k / 24.0);
  }
}

TEST_P(Each, TakesSubstepsAsItTakesFrames) {
  Motion whole(truth::bar("snh", 1e5, kGravity), GetParam(), 30.0, 1e-6);
  Motion fine(truth::bar("snh", 1e5, kGravity), GetParam(), 60.0, 1e-6);
  whole.time.substeps = 2;
  whole.advance(2);
  fine.advance(4);
  EXPECT_EQ(whole.state.q, fine.state.q);
  EXPECT_EQ(whole.state.qdot, fine.state.qdot);
}

/// The state is all there is: a new integrator goes on from it to the same bytes.
TEST_P(Each, GoesOnFromAStateToTheSameBytes) {
  Motion whole(truth::bar("snh", 1e5, kGravity), GetParam(), 30.0, 1e-6);
  whole.advance(3);
  Motion resumed(truth::bar("snh", 1e5, kGravity), GetParam(), 30.0, 1e-6);
  resumed.state = whole.state;
  whole.advance(3);
  resumed.advance(3);
  EXPECT_EQ(resumed.state.q, whole.state.q);
  EXPECT_EQ(resumed.state.qdot, whole.state.qdot);
}

TEST_P(Each, GivesTheSameBytesForAnyNumberOfThreads) {
  const auto run_with = [&](int threads) {
    const ThreadLimit limit(threads);
    Remarks remarks;
    BodyInput body{read_tet_mesh(lagomorph::tests::source_dir() / "assets/meshes/bunny_5k.msh", remarks), {}};
    body.settings.pin.emplace_back().top = 0.1;
    Motion run(Model({body}, kGravity), GetParam(), 30.0, 1e-6);
    run.advance(2);
    return run.state;
  };
  const State one = run_with(1), two = run_with(2), four = run_with(4);
  EXPECT_EQ(one.q, two.q);
  EXPECT_EQ(one.qdot, two.qdot);
  EXPECT_EQ(one.q, four.q);
  EXPECT_EQ(one.qdot, four.qdot);
}

/// Two iterations are too few for a frame but enough for a fraction of it.
TEST(AdvanceFrame, HalvesAStepThatDoesNotConverge) {
  Motion run(truth::bar("nh_lecture", 1e5, kGravity), "backward_euler", 5.0, 1e-7);
  run.solver.max_iterations = 2;
  run.integrator = make_integrator(run.time, run.solver, run.model);
  const FrameReport report = run.advance();
  EXPECT_EQ(report.status, StepStatus::converged) << report.reason;
  EXPECT_GT(report.halvings, 0);
  EXPECT_GT(report.steps, 1);
  EXPECT_LE(report.residual, 1e-7);
  EXPECT_EQ(run.state.t, 1 / 5.0);
  EXPECT_EQ(run.state.frame, 1);
}

TEST(AdvanceFrame, LeavesTheStateWhereItWasWhenItCannotGoOn) {
  Motion run(truth::bar("nh_lecture", 1e5, kGravity), "backward_euler", 5.0, 1e-9);
  run.advance(1);
  run.solver.max_iterations = 1;
  run.solver.max_halvings = 2;
  run.integrator = make_integrator(run.time, run.solver, run.model);
  const State before = run.state;
  const FrameReport report = run.advance();
  EXPECT_EQ(report.status, StepStatus::not_converged);
  EXPECT_EQ(report.halvings, 2);
  EXPECT_TRUE(
      report.reason.starts_with("frame 2: a step of 0.05 s at t = 0.2 s did not converge after 1 Newton "
                                "iterations with residual "))
      << report.reason;
  EXPECT_TRUE(report.reason.ends_with("(tolerance 1e-09), halved 2 times")) << report.reason;
  EXPECT_EQ(run.state.q, before.q);
  EXPECT_EQ(run.state.qdot, before.qdot);
  EXPECT_EQ(run.state.t, before.t);
  EXPECT_EQ(run.state.frame, before.frame);
}

TEST(AdvanceFrame, TellsTheRoundingFloor) {
  Motion run(truth::bar("snh", 1e6, kGravity), "backward_euler", 60.0, 1e-15);
  const FrameReport report = run.advance();
  EXPECT_EQ(report.status, StepStatus::rounding_floor);
  EXPECT_TRUE(report.hit_rounding_floor);
  EXPECT_EQ(report.halvings, 0);
}

/// A lecture's tet that one linear solve would turn inside out: the step is halved, or refused, but never
/// taken.
TEST(LinearlyImplicitEuler, DoesNotInvertANeoHookeanTet) {
  BodyInput body{cube_mesh(2), {}};
  body.settings.material.model = "neo_hookean";
  body.settings.material.young = 1e3;
  body.settings.velocity = Vec3(0, -100, 0);
  body.settings.pin.emplace_back().bottom = 0.1;
  Motion run(Model({body}, kGravity), "linearly_implicit_euler", 30.0, 1e-6);
  for (int k = 0; k < 5; ++k) {
    const FrameReport report = run.advance();
    EXPECT_TRUE(std::isfinite(run.model.energies_of(run.state).elastic));
    if (!is_good(report.status)) {
      EXPECT_FALSE(report.reason.empty());
      break;
    }
  }
}

/// M + h² K is indefinite in a strongly compressed body: it is solved nevertheless, not projected.
TEST(LinearlyImplicitEuler, SolvesAnIndefiniteSystem) {
  Motion run(reference_cube("snh"), "linearly_implicit_euler", 1.0, 1e-9);
  for (Eigen::Index i = 1; i < run.state.q.size(); i += 3) run.state.q[i] *= 0.3;
  const VecX q0 = run.state.q;
  BlockHessian A(run.model.pattern());
  VecX b = VecX::Zero(q0.size());
  for (const auto& term : run.model.energies()) {
    term->add_hessian(q0, 1.0, HessianKind::exact, A);
    term->add_gradient(q0, -1.0, b);
  }
  run.model.add_mass(1.0, A);
  const SparseMatrix P = run.model.pins().matrix();
  const Eigen::MatrixXd reduced = P * A.to_sparse() * SparseMatrix(P.transpose());
  ASSERT_LT(reduced.selfadjointView<Eigen::Lower>().eigenvalues()[0], 0.0);
  const VecX expected = P.transpose() * VecX(reduced.partialPivLu().solve(VecX(P * b)));
  run.advance(1);
  EXPECT_LT((run.state.qdot - expected).norm(), 1e-9 * expected.norm());
  EXPECT_LT((run.state.q - (q0 + expected)).norm(), 1e-9 * expected.norm());
}

TEST(MakeIntegrator, ListsTheValidNames) {
  EXPECT_EQ(integrator_names(),
            (std::vector<std::string>{"backward_euler", "linearly_implicit_euler", "bdf2",
                                      "implicit_midpoint", "trapezoidal", "symplectic_euler", "static"}));
  const Model model = free_cube(kGravity, Vec3::Zero());
  for (const std::string& name : integrator_names()) {
    TimeSettings time;
    time.integrator = name;
    const auto integrator = make_integrator(time, {}, model);
    EXPECT_EQ(integrator->name(), name);
    EXPECT_EQ(integrator->history_levels(), name == "bdf2" ? 1 : 0);
  }
}

TEST(MakeIntegrator, TellsWhatIsWrong) {
  const Model model = free_cube(kGravity, Vec3::Zero());
  const auto error = [&](auto change) {
    TimeSettings time;
    change(time);
    return error_of([&] { make_integrator(time, {}, model); });
  };
  using T = TimeSettings;
  EXPECT_EQ(error([](T& t) { t.integrator = "euler"; }),
            "unknown time.integrator 'euler'; valid ones are backward_euler, linearly_implicit_euler, bdf2, "
            "implicit_midpoint, trapezoidal, symplectic_euler, static");
  EXPECT_EQ(error([](T& t) { t.fps = 0.0; }), "time.fps = 0 must be > 0");
  EXPECT_EQ(error([](T& t) { t.substeps = 0; }), "time.substeps = 0 must be >= 1");
  SolverSettings solver;
  solver.tolerance = 2.0;
  for (const std::string& name : integrator_names()) {
    TimeSettings time;
    time.integrator = name;
    EXPECT_EQ(error_of([&] { make_integrator(time, solver, model); }),
              "solver.tolerance = 2 must be in (0, 1)");
  }
}

}  // namespace integrator_test
}  // namespace lagomorph::sim
