#include "apps/pipeline/motion.h"

#include "apps/scene/shutter.h"

namespace lagomorph::apps {

sim::VecX positions_between(const sim::State::Level& q0, const sim::State& q1, double h, double part) {
  constexpr double most = 0.25;  // of |m| over |c|
  const double s = part;
  sim::VecX q(q0.q.size());
  for (Eigen::Index i = 0; i < q.size(); i += 3) {
    const sim::Vec3 d = q1.q.segment<3>(i) - q0.q.segment<3>(i);
    const sim::Vec3 v0 = q0.qdot.segment<3>(i), v1 = q1.qdot.segment<3>(i);
    const sim::Vec3 c = 0.5 * (v0 - v1);
    sim::Vec3 m = 0.5 * (v0 + v1) - d / h;
    const double limit = most * c.norm(), size = m.norm();
    if (size > limit) m *= limit / size;
    q.segment<3>(i) = q0.q.segment<3>(i) + s * d + h * s * (1.0 - s) * (c + (1.0 - 2.0 * s) * m);
  }
  return q;
}

Motion motion_between(const sim::State::Level& before, const sim::State& at, double h, double shutter) {
  Motion motion{.before = before.q, .shutter = shutter, .open = {}};
  for (int step = 0; shutter > 0.0 && step < motion_segments; ++step)
    motion.open.push_back(positions_between(before, at, h, 1.0 - frames_to_go(step, shutter)));
  return motion;
}

}  // namespace lagomorph::apps
