#include "sim/vertex_rotations.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace vertex_rotations_test {

const Mat3 kTurn(Eigen::AngleAxisd(2.1, Vec3(1, -2, 0.5).normalized()));

VecX mapped(const TetMesh& mesh, const Mat3& A) {
  VecX q(3 * mesh.vertex_count());
  for (int v = 0; v < mesh.vertex_count(); ++v)
    q.segment<3>(3 * v) = A * Vec3(mesh.X.row(v).transpose()) + Vec3(3, -1, 2);
  return q;
}

TEST(VertexRotations, OfARigidMotionAreItsRotation) {
  const TetMesh mesh = cube_mesh(2);
  const VertexRotations found = vertex_rotations(mesh, mapped(mesh, kTurn));
  ASSERT_EQ(found.R.size(), static_cast<std::size_t>(mesh.vertex_count()));
  for (const Mat3& R : found.R) EXPECT_LT((R - kTurn).norm(), 1e-12);
  EXPECT_LT(found.strain, 1e-12);
}

TEST(VertexRotations, AreThatOfThePolarDecomposition) {
  const TetMesh mesh = cube_mesh(2);
  Mat3 S;
  S << 1.2, 0.1, 0.0, 0.1, 0.8, -0.05, 0.0, -0.05, 1.1;
  const VertexRotations found = vertex_rotations(mesh, mapped(mesh, kTurn * S));
  for (const Mat3& R : found.R) EXPECT_LT((R - kTurn).norm(), 1e-12);
  EXPECT_NEAR(found.strain, (S - Mat3::Identity()).norm(), 1e-12);
}

TEST(VertexRotations, AreTheIdentityWhereThereIsNone) {
  EXPECT_EQ(nearest_rotation(Mat3::Zero()), Mat3::Identity());
  EXPECT_EQ(nearest_rotation(Vec3(1, 1, -1).asDiagonal()), Mat3::Identity());
  EXPECT_EQ(nearest_rotation(Mat3::Constant(std::nan(""))), Mat3::Identity());
  EXPECT_LT((nearest_rotation(1e-6 * kTurn) - kTurn).norm(), 1e-12);
}

}  // namespace vertex_rotations_test
}  // namespace lagomorph::sim
