#include "sim/linear_solver.h"

#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace linear_solver_test {

/// A system on the cube's pattern: the graph's Laplacian in each coordinate, coupled at random, shifted by
/// `shift` times the identity.
BlockHessian system_on(const std::shared_ptr<const BlockPattern>& pattern, double shift) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  BlockHessian H(pattern);
  for (int j = 0; j < pattern->vertex_count(); ++j) {
    H.block(pattern->find(j, j)) += shift * Mat3::Identity();
    for (int k = pattern->starts()[static_cast<std::size_t>(j)];
         k < pattern->starts()[static_cast<std::size_t>(j) + 1]; ++k) {
      const int i = pattern->rows()[static_cast<std::size_t>(k)];
      if (i == j) continue;
      const Mat3 A = Mat3::NullaryExpr([&] { return uniform(random); });
      const Mat3 B =
          Mat3::NullaryExpr([&] { return uniform(random); });  // adds [A B]ᵀ[A B], positive semi-definite
      H.block(pattern->find(i, i)) += A.transpose() * A;
      H.block(pattern->find(j, j)) += B.transpose() * B;
      H.block(k) += A.transpose() * B;
    }
  }
  return H;
}

struct CubeSystem {
  TetMesh mesh = cube_mesh(3);
  std::shared_ptr<const BlockPattern> pattern =
      std::make_shared<const BlockPattern>(mesh.vertex_count(), mesh.tets);
  Pins pins;
  LinearSolver solver{1};
  VecX b = VecX::LinSpaced(3 * mesh.vertex_count(), -1.0, 2.0);

  explicit CubeSystem(const std::vector<int>& pinned) : CubeSystem(Pins(64, pinned)) {}
  explicit CubeSystem(const Pins& some) : pins(some) { solver.analyze(pattern, pins); }
  /// x = Pᵀ (P H Pᵀ)⁻¹ P b with a dense factorization.
  VecX expected(const BlockHessian& H) const {
    if (pins.free_dofs() == 0) return VecX::Zero(b.size());
    const SparseMatrix P = pins.matrix();
    const Eigen::MatrixXd reduced = P * H.to_sparse() * SparseMatrix(P.transpose());
    return P.transpose() * VecX(reduced.partialPivLu().solve(VecX(P * b)));
  }
};

TEST(LinearSolver, SolvesAsADenseOneDoes) {
  for (const std::vector<int>& pinned : {std::vector<int>{}, {0, 1, 2, 3}, {63, 5, 17}}) {
    CubeSystem cube(pinned);
    const BlockHessian H = system_on(cube.pattern, 0.1);
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
    const BlockHessian H = system_on(cube.pattern, shift);
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
    const BlockHessian H = system_on(cube.pattern, shift);
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
  EXPECT_EQ(cube.solver.factorize(system_on(cube.pattern, -3.0)), FactorStatus::not_positive_definite);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  const BlockHessian H = system_on(cube.pattern, 1.0);
  ASSERT_EQ(cube.solver.factorize(H), FactorStatus::ok);
  VecX x;
  cube.solver.solve(cube.b, x);
  EXPECT_LT((x - cube.expected(H)).norm(), 1e-12 * x.norm());
}

TEST(LinearSolver, FactorizesAnIndefiniteMatrixWhenAsked) {
  CubeSystem cube({0});
  const BlockHessian H = system_on(cube.pattern, -3.0);
  ASSERT_EQ(cube.solver.factorize_indefinite(H), FactorStatus::ok);
  VecX x;
  cube.solver.solve(cube.b, x);
  EXPECT_LT((x - cube.expected(H)).norm(), 1e-9 * x.norm());
}

TEST(LinearSolver, HasNothingToSolveWhenAllIsPinned) {
  std::vector<int> all(64);
  for (int v = 0; v < 64; ++v) all[static_cast<std::size_t>(v)] = v;
  CubeSystem cube(all);
  EXPECT_EQ(cube.solver.factorize(system_on(cube.pattern, -3.0)), FactorStatus::ok);
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
