#include "sim/rigid_motion.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace rigid_motion_test {

VecX at_rest(const TetMesh& mesh) { return as_q(mesh.X); }

VecX moved(const VecX& q, const Vec3& t, const Vec3& omega, const Vec3& center) {
  VecX dq(q.size());
  for (Eigen::Index i = 0; i < q.size(); i += 3)
    dq.segment<3>(i) = t + omega.cross(Vec3(q.segment<3>(i)) - center);
  return dq;
}

TEST(RigidMotion, IsAllOfATranslationAndATurn) {
  const VecX q = at_rest(cube_mesh(2));
  const VecX dq = moved(q, Vec3(0.3, -0.2, 0.1), Vec3(0.5, 1.0, -2.0), Vec3(4.0, 0.0, 1.0));
  EXPECT_LT((rigid_part(q, dq) - dq).norm(), 1e-13 * dq.norm());
}

TEST(RigidMotion, IsNothingOfAStretchAboutTheCentre) {
  const VecX q = at_rest(cube_mesh(2));
  VecX dq(q.size());
  for (Eigen::Index i = 0; i < q.size(); i += 3) dq.segment<3>(i) = q.segment<3>(i) - Vec3::Constant(0.5);
  EXPECT_LT(rigid_part(q, dq).norm(), 1e-13 * dq.norm());
}

TEST(RigidMotion, LeavesARemainderWithoutMomentum) {
  const VecX q = at_rest(cube_mesh(2));
  VecX dq(q.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) dq[i] = std::sin(7.0 * static_cast<double>(i * i));
  const VecX rest = dq - rigid_part(q, dq);
  Vec3 sum = Vec3::Zero(), turn = Vec3::Zero();
  for (Eigen::Index i = 0; i < q.size(); i += 3) {
    sum += rest.segment<3>(i);
    turn += Vec3(q.segment<3>(i)).cross(Vec3(rest.segment<3>(i)));
  }
  EXPECT_LT(sum.norm(), 1e-12);
  EXPECT_LT(turn.norm(), 1e-12);
  EXPECT_GT(rest.norm(), 1.0);
}

/// No turn about a line of vertices can be seen in them.
TEST(RigidMotion, OfVerticesOnALineIsFinite) {
  const VecX q = (VecX(9) << 0, 0, 0, 1, 0, 0, 2, 0, 0).finished();
  const VecX dq = moved(q, Vec3(0.0, 1.0, 0.0), Vec3(5.0, 0.0, 2.0), Vec3::Zero());
  EXPECT_LT((rigid_part(q, dq) - dq).norm(), 1e-13);
}

}  // namespace rigid_motion_test
}  // namespace lagomorph::sim
