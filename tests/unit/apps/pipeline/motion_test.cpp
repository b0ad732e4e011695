#include "apps/pipeline/motion.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "apps/scene/shutter.h"

namespace lagomorph::apps {
namespace motion_test {

using sim::Vec3;

constexpr double h = 1.0 / 24.0;  // [s]

sim::State::Level level(const Vec3& q, const Vec3& qdot) { return {.t = 0.0, .q = q, .qdot = qdot}; }
sim::State state(const Vec3& q, const Vec3& qdot) {
  sim::State s;
  s.frame = 1;
  s.t = h;
  s.q = q;
  s.qdot = qdot;
  return s;
}

Vec3 between(const sim::State::Level& a, const sim::State& b, double part) {
  return positions_between(a, b, h, part);
}

/// On the unit circle at an angle, going around at `turn` radians a frame.
Vec3 on_circle(double angle) { return {std::cos(angle), std::sin(angle), 0.3}; }
Vec3 around(double angle, double turn) { return turn / h * Vec3(-std::sin(angle), std::cos(angle), 0.0); }

TEST(Motion, IsOnTheArcOfARotation) {
  for (const double turn : {0.2, 0.8, 1.4}) {
    const sim::State::Level a = level(on_circle(0.4), around(0.4, turn));
    const sim::State b = state(on_circle(0.4 + turn), around(0.4 + turn, turn));
    double off = 0.0, off_chord = 0.0;
    for (int i = 0; i <= 100; ++i) {
      const double s = i / 100.0;
      off = std::max(off, (between(a, b, s) - on_circle(0.4 + s * turn)).norm());
      off_chord = std::max(off_chord, (a.q + s * (b.q - a.q) - on_circle(0.4 + s * turn)).norm());
    }
    EXPECT_LT(off, std::pow(turn, 4) / 384.0) << turn;  // as of a cubic Hermite curve of the arc
    EXPECT_GT(off_chord, 0.9 * turn * turn / 8.0) << turn;
    // What is drawn: straight between the time steps, which leaves 1/64 of what one line would.
    const Motion motion = motion_between(a, b, h, 1.0);
    double off_drawn = 0.0;
    for (int step = 0; step < motion_segments; ++step) {
      const auto k = static_cast<std::size_t>(step);
      const Vec3 next = step + 1 < motion_segments ? Vec3(motion.open[k + 1]) : Vec3(b.q);
      const Vec3 middle = 0.5 * (Vec3(motion.open[k]) + next);
      off_drawn =
          std::max(off_drawn, (middle - on_circle(0.4 + (step + 0.5) / motion_segments * turn)).norm());
    }
    EXPECT_LT(off_drawn, std::pow(turn, 4) / 384.0 + turn * turn / 512.0) << turn;
  }
}

TEST(Motion, IsTheParabolaOfFreeFall) {
  const Vec3 g(0, -9.81, 0), x(1, 2, 3), v(2, 1.0, -0.5);
  const sim::State::Level a = level(x, v);
  const sim::State b = state(x + h * v + 0.5 * h * h * g, v + h * g);
  for (const double s : {0.1, 0.5, 0.83})
    EXPECT_LT((between(a, b, s) - (x + s * h * v + 0.5 * s * s * h * h * g)).norm(), 1e-14);
}

/// Backward Euler falls by its own parabola, whose velocities are those of the middles of its steps.
TEST(Motion, IsNearTheParabolaWhereVelocitiesLag) {
  const Vec3 g(0, -9.81, 0), v(2, 1.0, -0.5);
  const sim::State::Level a = level(Vec3::Zero(), v);
  const sim::State b = state(h * (v + h * g), v + h * g);
  for (const double s : {0.2, 0.5, 0.8}) {
    const Vec3 parabola = s * h * v + 0.5 * s * (1.0 + s) * h * h * g, line = s * b.q;
    EXPECT_LT((between(a, b, s) - parabola).norm(), 0.2 * (line - parabola).norm()) << s;
  }
}

TEST(Motion, OfConstantVelocityIsAStraightLine) {
  const Vec3 x(0.3, -1, 2), v(3, -7, 1);
  const Motion motion = motion_between(level(x, v), state(x + h * v, v), h, 0.5);
  EXPECT_EQ(motion.before, x);
  ASSERT_EQ(motion.open.size(), static_cast<std::size_t>(motion_segments));
  for (int step = 0; step < motion_segments; ++step) {
    const double s = 0.5 + 0.5 * step / motion_segments;
    EXPECT_LT((Vec3(motion.open[static_cast<std::size_t>(step)]) - (x + s * h * v)).norm(), 1e-15) << step;
  }
}

/// What is told of states that are at rest or were put elsewhere: the line at an even pace.
TEST(Motion, WithoutAChangeOfVelocityIsAStraightLineWhateverTheVelocity) {
  const Vec3 x(0.3, -1, 2), y(0.5, -1.5, 2);
  for (const Vec3& v : {Vec3(0, 0, 0), Vec3(50, 10, -3)})
    EXPECT_LT((between(level(x, v), state(y, v), 0.3) - (x + 0.3 * (y - x))).norm(), 1e-14);
}

TEST(Motion, NeverLeavesTheLineByMoreThanTheChangeOfVelocityDoes) {
  std::mt19937 random(8);
  std::normal_distribution<double> normal;
  const auto any = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  double most = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const sim::State::Level a = level(any(), 100.0 * any());
    const sim::State b = state(any(), 100.0 * any());
    const double bound = 1.02 / 8.0 * h * (b.qdot - a.qdot).norm();
    for (double s = 0.0; s <= 1.0; s += 0.05) {
      const double off = (between(a, b, s) - (a.q + s * (b.q - a.q))).norm();
      ASSERT_LE(off, bound) << i << " " << s;
      most = std::max(most, off / bound);
    }
    EXPECT_EQ(between(a, b, 0.0), a.q);
    EXPECT_LT((between(a, b, 1.0) - b.q).norm(), 1e-14);
  }
  EXPECT_GT(most, 0.95);
}

/// A ball that comes to the floor at v and is thrown back within the frame: it goes into the floor by less
/// than 1/100 of its way in a frame. The unlimited cubic curve would by 0.067 of it.
TEST(Motion, AnImpactHardlyPassesTheFloor) {
  constexpr double v = 5.0;
  double lowest = 0.0;
  for (const double struck : {0.0, 0.2, 0.5, 0.9, 1.0}) {  // part of the frame before the floor is met
    const sim::State::Level a = level(Vec3(0, struck * h * v, 0), Vec3(0, -v, 0));
    const sim::State b = state(Vec3(0, (1.0 - struck) * h * v, 0), Vec3(0, v, 0));
    for (double s = 0.0; s <= 1.0; s += 0.01) lowest = std::min(lowest, between(a, b, s).y());
  }
  EXPECT_GT(lowest, -0.01 * h * v);
}

TEST(Motion, OfNoShutterIsOnlyWhereItWas) {
  const Motion motion =
      motion_between(level(Vec3::Zero(), Vec3::Ones()), state(Vec3::Ones(), Vec3::Ones()), h, 0.0);
  EXPECT_EQ(motion.before, Vec3::Zero());
  EXPECT_TRUE(motion.open.empty());
}

TEST(Motion, TheShutterIsOpenUntilTheFrame) {
  EXPECT_EQ(frames_to_go(0, 0.5), 0.5);
  EXPECT_EQ(frames_to_go(motion_segments / 2, 0.5), 0.25);
  EXPECT_EQ(frames_to_go(motion_segments, 0.5), 0.0);
}

}  // namespace motion_test
}  // namespace lagomorph::apps
