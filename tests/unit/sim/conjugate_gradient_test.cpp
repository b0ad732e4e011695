#include "sim/conjugate_gradient.h"

#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "sim/parallel.h"
#include "tests/unit/sim/mesh_fixtures.h"
#include "tests/unit/sim/systems.h"

namespace lagomorph::sim {
namespace conjugate_gradient_test {

struct Cube {
  TetMesh mesh;
  std::shared_ptr<const BlockPattern> pattern;
  Pins pins;
  VecX b;
  BlockJacobiCg cg;

  Cube(int cells, const std::vector<int>& pinned)
      : mesh(cube_mesh(cells)),
        pattern(std::make_shared<const BlockPattern>(mesh.vertex_count(), mesh.tets)),
        pins(mesh.vertex_count(), pinned),
        b(VecX::LinSpaced(3 * mesh.vertex_count(), -1.0, 2.0)) {
    cg.analyze(pattern, pins);
  }
};

TEST(BlockJacobiCg, SolvesAsADenseFactorizationDoes) {
  for (const std::vector<int>& pinned : {std::vector<int>{}, {0, 1, 2, 3}, {63, 5, 17}}) {
    Cube cube(3, pinned);
    const BlockHessian H = random_system(cube.pattern, 0.1);
    ASSERT_TRUE(cube.cg.set_matrix(H));
    VecX x;
    const CgReport report = cube.cg.solve(cube.b, {1e-12, 1000}, x);
    EXPECT_EQ(report.status, CgStatus::converged);
    EXPECT_LT((x - dense_solution(H, cube.pins, cube.b)).norm(), 1e-9 * x.norm());
    for (const int v : pinned) EXPECT_EQ(Vec3(x.segment<3>(3 * v)), Vec3::Zero());
  }
}

TEST(BlockJacobiCg, LeavesOutSingleCoordinates) {
  std::mt19937 random(7);
  std::vector<char> held(3 * 64);
  for (char& h : held) h = random() % 3 == 0;
  Cube cube(3, {});
  cube.pins = Pins(held);
  cube.cg.analyze(cube.pattern, cube.pins);
  const BlockHessian H = random_system(cube.pattern, 0.1);
  ASSERT_TRUE(cube.cg.set_matrix(H));
  VecX x;
  EXPECT_EQ(cube.cg.solve(cube.b, {1e-12, 1000}, x).status, CgStatus::converged);
  EXPECT_LT((x - dense_solution(H, cube.pins, cube.b)).norm(), 1e-9 * x.norm());
  for (int dof = 0; dof < x.size(); ++dof) EXPECT_EQ(held[static_cast<std::size_t>(dof)] != 0, x[dof] == 0.0);
}

TEST(BlockJacobiCg, StopsAtTheToleranceAskedFor) {
  Cube cube(4, {0, 1});
  const BlockHessian H = random_system(cube.pattern, 0.05);
  ASSERT_TRUE(cube.cg.set_matrix(H));
  int before = 0;
  for (const double tolerance : {1e-1, 1e-3, 1e-6, 1e-9}) {
    VecX x;
    const CgReport report = cube.cg.solve(cube.b, {tolerance, 1000}, x);
    EXPECT_LE(report.residual, tolerance);
    EXPECT_NEAR(residual_of(H, cube.pins, cube.b, x), report.residual, 1e-12);
    EXPECT_GT(report.iterations, before);
    before = report.iterations;
  }
}

TEST(BlockJacobiCg, TellsAMatrixThatIsNotPositiveDefinite) {
  Cube cube(3, {0});
  EXPECT_FALSE(cube.cg.set_matrix(random_system(cube.pattern, -30.0)));  // a diagonal block already
  // Only as a whole: all blocks of the diagonal are fine.
  ASSERT_TRUE(cube.cg.set_matrix(laplacian_system(cube.pattern, -0.6)));
  VecX x;
  EXPECT_EQ(cube.cg.solve(cube.b, {1e-10, 1000}, x).status, CgStatus::negative_curvature);
}

/// What is returned before it has converged still goes downhill.
TEST(BlockJacobiCg, GivesUpWithADirectionThatGoesDownhill) {
  Cube cube(4, {0, 1});
  const BlockHessian H = random_system(cube.pattern, 0.01);
  ASSERT_TRUE(cube.cg.set_matrix(H));
  VecX x;
  const CgReport report = cube.cg.solve(cube.b, {1e-9, 3}, x);
  EXPECT_EQ(report.status, CgStatus::gave_up);
  EXPECT_EQ(report.iterations, 3);
  EXPECT_GT(cube.b.dot(x), 0.0);
  EXPECT_LT(0.5 * x.dot(H.to_sparse() * x) - cube.b.dot(x), 0.0);
}

/// At the rate so far it would take too long, and that is told before the iterations have run out.
TEST(BlockJacobiCg, GivesUpEarlyWhereItIsHopeless) {
  Cube cube(12, {0});
  ASSERT_TRUE(cube.cg.set_matrix(laplacian_system(cube.pattern, 1e-4)));
  VecX x;
  const CgReport all = cube.cg.solve(cube.b, {1e-8, 10000}, x);
  ASSERT_EQ(all.status, CgStatus::converged);
  const int too_few = all.iterations / 3;
  ASSERT_GT(too_few, 16);
  const CgReport report =
      cube.cg.solve(cube.b, {.tolerance = 1e-8, .max_iterations = too_few, .probe = 8, .goal = 1e-8}, x);
  EXPECT_EQ(report.status, CgStatus::gave_up);
  EXPECT_LT(report.iterations, too_few);
}

TEST(BlockJacobiCg, GivesTheSameBitsForAnyNumberOfThreads) {
  Cube cube(13, {0, 1, 2});  // 2,744 vertices: several pieces of work
  const BlockHessian H = random_system(cube.pattern, 0.1);
  std::vector<VecX> solutions;
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    ASSERT_TRUE(cube.cg.set_matrix(H));
    cube.cg.solve(cube.b, {1e-6, 1000}, solutions.emplace_back());
  }
  EXPECT_EQ(solutions[0], solutions[1]);
  EXPECT_EQ(solutions[0], solutions[2]);
}

TEST(BlockJacobiCg, HasNothingToDoForZeroAndWhereAllIsPinned) {
  Cube cube(3, {0});
  ASSERT_TRUE(cube.cg.set_matrix(random_system(cube.pattern, 1.0)));
  VecX x;
  EXPECT_EQ(cube.cg.solve(VecX::Zero(cube.b.size()), {}, x).iterations, 0);
  EXPECT_EQ(x, VecX::Zero(cube.b.size()));
  std::vector<int> all(64);
  for (int v = 0; v < 64; ++v) all[static_cast<std::size_t>(v)] = v;
  Cube pinned(3, all);
  EXPECT_TRUE(pinned.cg.set_matrix(random_system(pinned.pattern, 1.0)));
  EXPECT_EQ(pinned.cg.solve(pinned.b, {}, x).status, CgStatus::converged);
  EXPECT_EQ(x, VecX::Zero(pinned.b.size()));
}

}  // namespace conjugate_gradient_test
}  // namespace lagomorph::sim
