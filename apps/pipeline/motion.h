#pragma once

#include <vector>

#include "sim/model.h"

/// How bodies come to a frame, for motion vectors and motion blur.
namespace lagomorph::apps {

/// The way from the frame before to a frame, as far as the shutter is open.
struct Motion {
  sim::VecX before;             // positions a frame earlier, 3n [m]
  double shutter = 0.0;         // part of the time between that it is open, until the frame, in [0, 1]
  std::vector<sim::VecX> open;  // positions at the times of frames_to_go() but the frame's; empty: no blur
};

/// Positions at a part of the time h from one state to the next, 3n [m], with d = q1 - q0 and s the part:
///   q0 + s d + h s (1-s) (c + (1-2s) m),   c = (q̇0 - q̇1)/2,   m = (q̇0 + q̇1)/2 - d/h,
/// which is the cubic Hermite curve through both positions with both velocities as long as m is as it stands.
/// c is what a constant acceleration does. m is where velocities and positions disagree: by the jerk of a
/// smooth motion, by the lag of first order schemes, whose velocity is that of the middle of the last step,
/// and by jumps within the frame. So |m| of a vertex is limited to |c|/4, which a smooth rotation comes to
/// at 1.4 radians a frame. Then the curve is never further from the straight line at the same time
/// than 1.02/8 h |q̇1 - q̇0|, and is that line where both velocities are equal, whatever they are, as those of
/// an equilibrium, which are 0. A jump of velocity, as of an impact, is rounded to nearly a parabola between
/// the states.
sim::VecX positions_between(const sim::State::Level& q0, const sim::State& q1, double h, double part);

/// The same at the times that the shutter is open, for `h` seconds between the states.
Motion motion_between(const sim::State::Level& before, const sim::State& at, double h, double shutter);

}  // namespace lagomorph::apps
