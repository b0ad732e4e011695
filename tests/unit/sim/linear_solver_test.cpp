#include "sim/linear_solver.h"

#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/unit/sim/mesh_fixtures.h"
#include "tests/unit/sim/systems.h"

namespace lagomorph::sim {
namespace linear_solver_test {

struct CubeSystem {
  TetMesh mesh = cube_mesh(3);
  std::shared_ptr<const BlockPattern> pattern =
      std::make_shared<const BlockPattern>(mesh.vertex_count(), mesh.tets);
  Pins pins;
  LinearSolver solver{1};
  VecX b = VecX::LinSpaced(3 * mesh.vertex_count(), -1.0, 2.0);

  explicit CubeSystem(const std::vector<int>& pinned) : CubeSystem(Pins(64, pinned)) {}
  explicit CubeSystem(const Pins& some) : pins(some) { solver.analyze(pattern, pins); }
  VecX expected(const BlockHessian& H) const { return dense_solution(H, pins, b); }
};

TEST(LinearSolver, SolvesAsADenseOneDoes) {
  for (const std::vector<int>& pinned : {std::vector<int>{}, {0, 1, 2, 3}, {63, 5, 17}}) {
    CubeSystem cube(pinned);
    const BlockHessian H = random_system(cube.pattern, 0.1);
    ASSERT_EQ(cube.solver.factorize(H), FactorStatus::ok);
    VecX x;
    cube.solver.solve(cube.b, x);
    EXPECT_LT((x - cube.expected(H)).norm(), 1e-12 * x.norm());
    for (const int v : pinned) EXPECT_EQ(Vec3(x.segment<3>(3 * v)), Vec3::Zero());
  }
}

/// Every mixture of free and held axes on the way, many of a kind.
TEST(LinearSolver, LeavesOutSingleCoordinates) {
  std::mt19937 random(7);
  std::vector<char> held(3 * 64);
  for (char& h : held) h = random() % 3 == 0;
  CubeSystem cube{Pins(held)};
  ASSERT_LT(cube.pins.free_vertices().size(), 64u);
  ASSERT_GT(cube.pins.free_dofs() % 3, 0);
  for (const double shift : {0.1, -3.0}) {
    const BlockHessian H = random_system(cube.pattern, shift);
    ASSERT_EQ(shift > 0 ? cube.solver.factorize(H) : cube.solver.factorize_indefinite(H), FactorStatus::ok);
    VecX x;
    cube.solver.solve(cube.b, x);
    EXPECT_LT((x - cube.expected(H)).norm(), (shift > 0 ? 1e-12 : 1e-9) * x.norm());
    for (int dof = 0; dof < x.size(); ++dof)
      EXPECT_EQ(held[static_cast<std::size_t>(dof)] != 0, x[dof] == 0.0);
  }
}

TEST(LinearSolver, FactorizesAgainWithOtherValues) {
  CubeSystem cube({0});
  for (const double shift : {1.0, 10.0, 0.3}) {
    const BlockHessian H = random_system(cube.pattern, shift);
    ASSERT_EQ(cube.solver.factorize(H), FactorStatus::ok);
    VecX x;
    cube.solver.solve(cube.b, x);
    EXPECT_LT((x - cube.expected(H)).norm(), 1e-12 * x.norm());
  }
}

TEST(LinearSolver, TellsAMatrixThatIsNotPositiveDefiniteSilentlyAndGoesOn) {
  CubeSystem cube({0});
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  EXPECT_EQ(cube.solver.factorize(random_system(cube.pattern, -3.0)), FactorStatus::not_positive_definite);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  const BlockHessian H = random_system(cube.pattern, 1.0);
  ASSERT_EQ(cube.solver.factorize(H), FactorStatus::ok);
  VecX x;
  cube.solver.solve(cube.b, x);
  EXPECT_LT((x - cube.expected(H)).norm(), 1e-12 * x.norm());
}

TEST(LinearSolver, FactorizesAnIndefiniteMatrixWhenAsked) {
  CubeSystem cube({0});
  const BlockHessian H = random_system(cube.pattern, -3.0);
  ASSERT_EQ(cube.solver.factorize_indefinite(H), FactorStatus::ok);
  VecX x;
  cube.solver.solve(cube.b, x);
  EXPECT_LT((x - cube.expected(H)).norm(), 1e-9 * x.norm());
}

TEST(LinearSolver, HasNothingToSolveWhenAllIsPinned) {
  std::vector<int> all(64);
  for (int v = 0; v < 64; ++v) all[static_cast<std::size_t>(v)] = v;
  CubeSystem cube(all);
  EXPECT_EQ(cube.solver.factorize(random_system(cube.pattern, -3.0)), FactorStatus::ok);
  VecX x;
  cube.solver.solve(cube.b, x);
  EXPECT_EQ(x, VecX::Zero(cube.b.size()));
}

TEST(LinearSolver, TellsTheSizeOfTheFactor) {
  CubeSystem cube(std::vector<int>{});
  const double n = 192;
  EXPECT_GE(cube.solver.factor_nonzeros(), n);
  EXPECT_LE(cube.solver.factor_nonzeros(), n * (n + 1) / 2);
  EXPECT_GT(cube.solver.factor_flops(), cube.solver.factor_nonzeros());
}

TEST(LinearAlgebra, IsOpenBLASUnderCHOLMOD) {
  CubeSystem cube(std::vector<int>{});  // sets the threads
  const LinearAlgebraInfo info = linear_algebra_info();
  EXPECT_TRUE(info.blas_is_openblas) << info.blas_library;
  EXPECT_TRUE(info.blas.starts_with("OpenBLAS ")) << info.blas;
  EXPECT_FALSE(info.blas_kernel.empty());
  EXPECT_EQ(info.blas_threads, 1);
  EXPECT_EQ(std::count(info.cholmod.begin(), info.cholmod.end(), '.'), 2) << info.cholmod;
}

}  // namespace linear_solver_test
}  // namespace lagomorph::sim
