#include "sim/pin_motion.h"

#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/finite_differences.h"
#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace pin_motion_test {

Points two_points() {
  Points X(2, 3);
  X << 0, 0, 0, 2, 0, 0;
  return X;
}

PinSettings keys(std::vector<PinKey> k, const std::string& interpolation = "smooth") {
  PinSettings pin;
  pin.key = std::move(k);
  pin.interpolation = interpolation;
  return pin;
}

PinMotion motion(const PinSettings& pin, const Recording& path = {}) {
  return {pin, path, two_points(), "here"};
}

TEST(PinMotion, TurnsScalesAndShiftsAboutTheMiddleOfItsVertices) {
  const PinMotion m =
      motion(keys({{.time = 2.0, .translate = {0, 0, 5}, .rotate = {0, 0, 90}, .scale = 2.0}}));
  Points end(2, 3);
  end << 1, -2, 5, 1, 2, 5;
  EXPECT_LT((m.positions(2.0) - end).norm(), 1e-15);
  EXPECT_EQ(m.positions(7.0), m.positions(2.0));
  EXPECT_EQ(m.positions(0.0), two_points());  // the key before the first is the rest position at 0
  EXPECT_LT((m.positions(1.0).colwise().mean() - Vec3(1, 0, 2.5).transpose()).norm(), 1e-15);  // half way
  EXPECT_TRUE(m.velocities(0.0).isZero(0.0));
  EXPECT_TRUE(m.velocities(2.0).isZero(1e-14));
  EXPECT_TRUE(m.velocities(3.0).isZero(0.0));
}

TEST(PinMotion, TurnsAboutACenterOfItsOwnAndMoreThanOnce) {
  PinSettings pin = keys({{.time = 4.0, .rotate = {0, 0, 720}}}, "linear");
  pin.center = Vec3(0, 0, 0);
  const PinMotion m = motion(pin);
  for (const double t : {0.5, 1.0, 1.7, 3.9}) {
    const double angle = std::numbers::pi * t;
    EXPECT_LT((m.positions(t).row(1) - Vec3(2 * std::cos(angle), 2 * std::sin(angle), 0).transpose()).norm(),
              1e-14);
    EXPECT_LT((m.positions(t).row(0)).norm(), 1e-14);
  }
}

/// The velocity is the derivative of the position, of every channel at once.
TEST(PinMotion, HasTheVelocityOfItsPositions) {
  for (const char* interpolation : {"smooth", "linear"}) {
    const PinMotion m =
        motion(keys({{.time = 0.0, .rotate = {10, 0, 5}},
                     {.time = 1.0, .translate = {1, 2, 3}, .rotate = {100, 40, -70}, .scale = 1.5},
                     {.time = 1.5, .translate = {2, 2, 1}, .rotate = {130, 90, 20}, .scale = 0.5},
                     {.time = 4.0}},
                    interpolation));
    for (const double t : {0.3, 1.2, 2.5}) {
      const auto along = [&](double s) {
        const Points x = m.positions(t + s);
        return VecX(Eigen::Map<const VecX>(x.data(), x.size()));
      };
      const Points v = m.velocities(t);
      expect_second_order(along, VecX(Eigen::Map<const VecX>(v.data(), v.size())));
    }
  }
}

TEST(PinMotion, IsOnceDifferentiableMonotoneAndRestsWhereItTurnsWhenSmooth) {
  const PinMotion m = motion(keys({{.time = 1.0, .translate = {1, 0, 0}},
                                   {.time = 1.2, .translate = {3, 0, 0}},
                                   {.time = 3.0, .translate = {-1, 0, 0}},
                                   {.time = 4.0, .translate = {-1, 0, 0}}}));
  for (const double t : {1.0, 1.2, 3.0}) {
    EXPECT_LT((m.velocities(t - 2e-9) - m.velocities(t + 2e-9)).norm(), 1e-6);
    EXPECT_LT((m.positions(t - 1e-9) - m.positions(t + 1e-9)).norm(), 1e-7);
  }
  EXPECT_GT(m.velocities(1.0)(0, 0), 0.5);  // it does not stop on its way
  EXPECT_TRUE(m.velocities(1.2).isZero(1e-12));
  for (double t = 0.0; t < 4.5; t += 0.01) {
    const double x = m.positions(t)(0, 0), v = m.velocities(t)(0, 0);
    EXPECT_LE(std::abs(x - 1.0), 2.0);  // never beyond its keys
    EXPECT_GE(t < 1.2 ? v : -v, -1e-12);
  }
}

TEST(PinMotion, OfALinearBendIsWhatArrivesThere) {
  const PinMotion m =
      motion(keys({{.time = 1.0, .translate = {1, 0, 0}}, {.time = 3.0, .translate = {5, 0, 0}}}, "linear"));
  EXPECT_EQ(m.velocities(0.0)(0, 0), 1.0);
  for (const double rounding : {-1e-15, 0.0, 1e-15}) {
    EXPECT_EQ(m.velocities(1.0 + rounding)(0, 0), 1.0);
    EXPECT_EQ(m.velocities(3.0 + rounding)(0, 0), 2.0);
  }
  EXPECT_EQ(m.velocities(1.1)(0, 0), 2.0);
  EXPECT_EQ(m.velocities(3.1)(0, 0), 0.0);
}

TEST(PinMotion, FollowsARecordedPath) {
  PinSettings pin;
  pin.path_fps = 10.0;
  pin.interpolation = "linear";
  const Recording shift{.samples = 3, .vertices = 0, .values = {0, 0, 0, 0, 1, 0, 0, 1, 4}};
  EXPECT_EQ(motion(pin, shift).positions(0.1).row(1), Eigen::RowVector3d(2, 1, 0));
  EXPECT_LT((motion(pin, shift).positions(0.15).row(0) - Eigen::RowVector3d(0, 1, 2)).norm(), 1e-14);
  EXPECT_EQ(motion(pin, shift).positions(9.0).row(0), Eigen::RowVector3d(0, 1, 4));
  const Recording each{.samples = 2, .vertices = 2, .values = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}};
  Points first(2, 3);
  first << 1, 2, 3, 4, 5, 6;
  EXPECT_EQ(motion(pin, each).positions(0.0), first);
  EXPECT_LT((motion(pin, each).velocities(0.05) - Points::Constant(2, 3, 60.0)).norm(), 1e-12);
  pin.interpolation = "smooth";
  EXPECT_LT((motion(pin, each).velocities(0.0) - Points::Constant(2, 3, 60.0)).norm(), 1e-12);  // not at rest
}

TEST(PinMotion, TellsWhatIsWrong) {
  EXPECT_EQ(error_of([] {
              motion(keys({{.time = 1.0}, {.time = 1.0}}));
            }),
            "here: key 1: time = 1 must be later than the 1 before it");
  EXPECT_EQ(error_of([] { motion(keys({{.time = -1.0}})); }), "here: key 0: time = -1 must be >= 0");
  EXPECT_EQ(error_of([] { motion(keys({{.time = 1.0, .scale = 0.0}})); }),
            "here: key 0: scale = 0 must be > 0");
  EXPECT_EQ(error_of([] { motion(keys({{.time = 1.0}}, "cubic")); }),
            "here: unknown interpolation 'cubic'; valid ones are smooth, linear");
  PinSettings pin = keys({{.time = 1.0}});
  pin.path_fps = 10.0;
  const Recording path{.samples = 1, .vertices = 3, .values = std::vector<double>(9)};
  EXPECT_EQ(error_of([&] { motion(pin, path); }), "here: has both keys and a path; give one of them");
  pin.key.clear();
  EXPECT_EQ(error_of([&] { motion(pin, path); }), "here: its path is of 3 vertices; the pin holds 2");
  pin.path_fps.reset();
  EXPECT_EQ(error_of([&] { motion(pin, path); }), "here: path_fps must be > 0");
}

}  // namespace pin_motion_test
}  // namespace lagomorph::sim
