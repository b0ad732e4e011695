#include "sim/rigid_motion.h"

#include <Eigen/Geometry>
#include <Eigen/QR>

namespace lagomorph::sim {

VecX rigid_part(const Eigen::Ref<const VecX>& q, const Eigen::Ref<const VecX>& dq) {
  const Eigen::Index n = q.size() / 3;
  const Eigen::Map<const Points> x(q.data(), n, 3), d(dq.data(), n, 3);
  const Eigen::RowVector3d center = x.colwise().mean(), t = d.colwise().mean();
  Mat3 second = Mat3::Zero();  // Σ (|r|² I - r rᵀ) with r = x - c
  Vec3 turned = Vec3::Zero();  // Σ r × d
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec3 r = x.row(i) - center;
    second += r.squaredNorm() * Mat3::Identity() - r * r.transpose();
    turned += r.cross(Vec3(d.row(i) - t));
  }
  // The least ω where all vertices are on a line, about which none turns.
  const Vec3 omega = second.completeOrthogonalDecomposition().solve(turned);
  VecX rigid(q.size());
  for (Eigen::Index i = 0; i < n; ++i)
    rigid.segment<3>(3 * i) = Vec3(t) + omega.cross(Vec3(x.row(i) - center));
  return rigid;
}

}  // namespace lagomorph::sim
