#include "sim/system_solver.h"

#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/unit/sim/mesh_fixtures.h"
#include "tests/unit/sim/systems.h"

namespace lagomorph::sim {
namespace system_solver_test {

struct Cube {
  TetMesh mesh;
  std::shared_ptr<const BlockPattern> pattern;
  Pins pins;
  VecX b;

  explicit Cube(int cells, const std::vector<int>& pinned = {0, 1, 2})
      : mesh(cube_mesh(cells)),
        pattern(std::make_shared<const BlockPattern>(mesh.vertex_count(), mesh.tets)),
        pins(mesh.vertex_count(), pinned),
        b(VecX::LinSpaced(3 * mesh.vertex_count(), -1.0, 2.0)) {}

  SystemSolver solver(const std::string& linear) const {
    SolverSettings settings;
    settings.linear = linear;
    SystemSolver solver(settings);
    solver.analyze(pattern, pins);
    solver.begin(1.0);
    return solver;
  }
};

class SystemSolverBy : public testing::TestWithParam<const char*> {};

/// The systems of a minimization: each a little different from the one before.
TEST_P(SystemSolverBy, SolvesOneSystemAfterTheOther) {
  const Cube cube(5);
  SystemSolver solver = cube.solver(GetParam());
  for (const double shift : {1.0, 1.1, 1.3, 30.0}) {
    const BlockHessian H = random_system(cube.pattern, shift);
    VecX x;
    ASSERT_EQ(solver.solve(H, cube.b, 1e-8, 1e-8, x), FactorStatus::ok);
    EXPECT_LE(residual_of(H, cube.pins, cube.b, x), 1.01e-8);
    for (const int v : cube.pins.vertices()) EXPECT_EQ(Vec3(x.segment<3>(3 * v)), Vec3::Zero());
  }
}

TEST_P(SystemSolverBy, TellsWhatIsNotPositiveDefiniteAndGoesOn) {
  const Cube cube(3);
  SystemSolver solver = cube.solver(GetParam());
  VecX x;
  EXPECT_EQ(solver.solve(random_system(cube.pattern, -3.0), cube.b, 1e-8, 1e-8, x),
            FactorStatus::not_positive_definite);
  const BlockHessian H = random_system(cube.pattern, 1.0);
  ASSERT_EQ(solver.solve(H, cube.b, 1e-8, 1e-8, x), FactorStatus::ok);
  EXPECT_LE(residual_of(H, cube.pins, cube.b, x), 1.01e-8);
  EXPECT_EQ(solver.solve(random_system(cube.pattern, -3.0), cube.b, 1e-8, 1e-8, x),
            FactorStatus::not_positive_definite);
}

/// So that a run that is taken up again at any step does the same.
TEST_P(SystemSolverBy, RemembersNothingOfTheMinimizationBefore) {
  const Cube cube(5);
  const BlockHessian H = random_system(cube.pattern, 1.0), other = random_system(cube.pattern, 1.5);
  SystemSolver fresh = cube.solver(GetParam()), used = cube.solver(GetParam());
  VecX x, y;
  ASSERT_EQ(used.solve(other, cube.b, 1e-5, 1e-5, x), FactorStatus::ok);
  used.begin(1.0);
  ASSERT_EQ(used.solve(H, cube.b, 1e-5, 1e-5, x), FactorStatus::ok);
  ASSERT_EQ(fresh.solve(H, cube.b, 1e-5, 1e-5, y), FactorStatus::ok);
  EXPECT_EQ(x, y);
}

INSTANTIATE_TEST_SUITE_P(Ways, SystemSolverBy, testing::Values("auto", "cholmod", "cg"),
                         [](const auto& info) { return std::string(info.param); });

TEST(SystemSolver, KeepsTheFactorWhileItServes) {
  const Cube cube(5);
  SystemSolver solver = cube.solver("cholmod");
  VecX x;
  ASSERT_EQ(solver.solve(random_system(cube.pattern, 1.0), cube.b, 1e-6, 1e-6, x), FactorStatus::ok);
  ASSERT_EQ(solver.solve(random_system(cube.pattern, 1.001), cube.b, 1e-6, 1e-6, x), FactorStatus::ok);
  EXPECT_EQ(solver.counts().factorizations, 1);
  EXPECT_GT(solver.counts().factor_iterations, 0);
  ASSERT_EQ(solver.solve(random_system(cube.pattern, 1e4), cube.b, 1e-12, 1e-12, x), FactorStatus::ok);
  EXPECT_EQ(solver.counts().factorizations, 2);
  // Where matrices may be singular, each has its own.
  solver.begin(0.0);
  for (int k = 0; k < 3; ++k)
    ASSERT_EQ(solver.solve(random_system(cube.pattern, 1.0), cube.b, 1e-6, 1e-6, x), FactorStatus::ok);
  EXPECT_EQ(solver.counts().factorizations, 5);
}

TEST(SystemSolver, ChoosesByTheWork) {
  const auto counts = [](int cells, double shift_at_rest, double shift) {
    const Cube cube(cells);
    SystemSolver solver = cube.solver("auto");
    if (solver.needs_trial(1.0))
      solver.try_at_rest(1.0, laplacian_system(cube.pattern, shift_at_rest), cube.b);
    EXPECT_FALSE(solver.needs_trial(1.0));
    solver.begin(1.0);
    VecX x;
    EXPECT_EQ(solver.solve(laplacian_system(cube.pattern, shift), cube.b, 1e-3, 1e-9, x), FactorStatus::ok);
    return solver.counts();
  };
  const SolveCounts small = counts(3, 1.0, 1.0), easy = counts(14, 1.0, 1.0), hard = counts(14, 1.0, 1e-7);
  EXPECT_EQ(small.cg_iterations, 0);  // a small factor is soon made
  EXPECT_EQ(small.factorizations, 1);
  EXPECT_GT(easy.cg_iterations, 0);
  EXPECT_EQ(easy.factorizations, 0);
  EXPECT_GT(hard.cg_iterations, 0);  // it is tried,
  EXPECT_LT(hard.cg_iterations, 400);
  EXPECT_EQ(hard.factorizations, 1);  // and given up
}

/// R H Rᵀ, with a rotation a vertex.
BlockHessian turned(const BlockHessian& H, const std::vector<Mat3>& R) {
  BlockHessian to(H.shared_pattern());
  const BlockPattern& pattern = H.pattern();
  for (int j = 0; j < pattern.vertex_count(); ++j) {
    for (int k = pattern.starts()[static_cast<std::size_t>(j)];
         k < pattern.starts()[static_cast<std::size_t>(j) + 1]; ++k) {
      const auto i = static_cast<std::size_t>(pattern.rows()[static_cast<std::size_t>(k)]);
      to.block(k) = R[i] * H.block(k) * R[static_cast<std::size_t>(j)].transpose();
    }
  }
  return to;
}

TEST(SystemSolver, TurnsTheFactorAtRestWithTheBody) {
  const Cube cube(12);
  // Springs of very different stiffness, on which conjugate gradients alone would be long.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> exponent(-4.0, 4.0);
  const BlockHessian at_rest =
      coupled_system(cube.pattern, 1e-4, [&](Eigen::Map<Mat3> a, Eigen::Map<Mat3> both, Eigen::Map<Mat3> b) {
        const Mat3 k = std::pow(10.0, exponent(random)) * Mat3::Identity();
        a += k, b += k, both -= k;
      });
  VertexRotations rotations;
  for (int v = 0; v < cube.mesh.vertex_count(); ++v)
    rotations.R.emplace_back(Eigen::AngleAxisd(0.4 + 0.01 * v, Vec3(1, 2, 2).normalized()));
  for (const int v : cube.pins.vertices()) rotations.R[static_cast<std::size_t>(v)] = Mat3::Identity();
  const BlockHessian now = turned(at_rest, rotations.R);
  const auto counts = [&](double strain) {
    SystemSolver solver = cube.solver("auto");
    // So stiff that it is left to a factor.
    solver.try_at_rest(1.0, at_rest, VecX::Ones(cube.b.size()));
    rotations.strain = strain;
    solver.begin(1.0, [&] { return rotations; });
    VecX x;
    EXPECT_EQ(solver.solve(now, cube.b, 1e-8, 1e-8, x), FactorStatus::ok);
    EXPECT_LE(residual_of(now, cube.pins, cube.b, x), 1.01e-8);
    return solver.counts();
  };
  const SolveCounts small = counts(0.001), large = counts(0.1);
  EXPECT_EQ(small.cg_iterations, 0);
  EXPECT_EQ(small.factorizations, 0);
  EXPECT_EQ(small.factor_iterations, 1);  // it is the very factor
  EXPECT_EQ(large.factorizations, 1);
  EXPECT_EQ(large.factor_iterations, 0);
}

TEST(SystemSolver, HasNothingToSolveWhenAllIsPinned) {
  std::vector<int> all(64);
  for (int v = 0; v < 64; ++v) all[static_cast<std::size_t>(v)] = v;
  const Cube cube(3, all);
  for (const char* const linear : {"auto", "cholmod", "cg"}) {
    SystemSolver solver = cube.solver(linear);
    VecX x;
    EXPECT_EQ(solver.solve(random_system(cube.pattern, 1.0), cube.b, 1e-6, 1e-6, x), FactorStatus::ok);
    EXPECT_EQ(x, VecX::Zero(cube.b.size()));
  }
}

}  // namespace system_solver_test
}  // namespace lagomorph::sim
