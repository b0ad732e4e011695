#include "sim/loads.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "sim/model.h"
#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace loads_test {

/// The force on the unit cube's vertices at t.
VecX force_of(const LoadSettings& load, double t = 0.0, int n = 3) {
  BodyInput body{cube_mesh(n), {}};
  body.settings.density = 500.0;
  body.settings.load = {load};
  return Model({body}, Vec3::Zero()).load_force(t);
}

Vec3 total(const VecX& f) { return as_points(f).colwise().sum().transpose(); }

Vec3 torque(const VecX& f, int n = 3) {
  const Points X = cube_mesh(n).X;
  Vec3 sum = Vec3::Zero();
  for (int v = 0; v < X.rows(); ++v) sum += Vec3(X.row(v)).cross(Vec3(f.segment<3>(3 * v)));
  return sum;
}

TEST(Curve, IsLinearBetweenItsPointsAndConstantOutside) {
  const std::vector<std::array<double, 2>> curve = {{1, 2}, {2, 0}, {4, -4}};
  EXPECT_EQ(curve_at({}, 3.0), 1.0);
  EXPECT_EQ(curve_at(curve, 0.0), 2.0);
  EXPECT_EQ(curve_at(curve, 1.25), 1.5);
  EXPECT_EQ(curve_at(curve, 2.0), 0.0);
  EXPECT_EQ(curve_at(curve, 3.0), -2.0);
  EXPECT_EQ(curve_at(curve, 9.0), -4.0);
}

TEST(Loads, PartAForceEquallyAmongTheSelectedVertices) {
  LoadSettings load;
  load.vertices = {5, 9, 11};
  load.force = Vec3(3, -6, 9);
  load.curve = {{0, 0}, {2, 1}};
  const VecX f = force_of(load, 1.0);
  EXPECT_EQ(Vec3(f.segment<3>(27)), Vec3(0.5, -1, 1.5));
  EXPECT_LT((total(f) - Vec3(1.5, -3, 4.5)).norm(), 1e-14);
}

/// The face y = 1 of area 1: the sum is the traction, and it acts at the middle of the face.
TEST(Loads, OfTractionActOnBoundaryTrianglesWithAllCornersSelected) {
  LoadSettings load;
  load.plane = PlaneSelector{Vec3(0, 1, 0), Vec3(0, 1, 0)};
  load.traction = Vec3(2, 3, 4);
  const VecX f = force_of(load);
  EXPECT_LT((total(f) - Vec3(2, 3, 4)).norm(), 1e-14);
  EXPECT_LT((torque(f) - Vec3(0.5, 1, 0.5).cross(Vec3(2, 3, 4))).norm(), 1e-14);
  const Points X = cube_mesh(3).X;
  for (int v = 0; v < X.rows(); ++v) EXPECT_EQ(f.segment<3>(3 * v).isZero(0.0), X(v, 1) != 1.0);
  load.traction.setZero();
  load.pressure = 7.0;  // against the outward normal
  EXPECT_LT((total(force_of(load)) - Vec3(0, -7, 0)).norm(), 1e-14);
}

TEST(Loads, OfPressureAllAroundCancel) {
  LoadSettings load;
  load.pressure = 1e3;
  const VecX f = force_of(load);
  EXPECT_GT(f.norm(), 100.0);
  EXPECT_LT(total(f).norm(), 1e-12);
  EXPECT_LT(torque(f).norm(), 1e-12);
}

TEST(Loads, OfTheBulkGoByVolumeAndMass) {
  LoadSettings load;
  load.body_force = Vec3(0, 0, 30);
  EXPECT_LT((total(force_of(load)) - Vec3(0, 0, 30)).norm(), 1e-13);
  load.body_force.setZero();
  load.acceleration = Vec3(1, 2, 0);
  EXPECT_LT((total(force_of(load)) - 500.0 * Vec3(1, 2, 0)).norm(), 1e-10);
  // The same as gravity's.
  BodyInput body{cube_mesh(3), {}};
  body.settings.density = 500.0;
  EXPECT_LT((force_of(load) - Model({body}, load.acceleration).gravity_force()).norm(), 1e-10);
  load.box = BoxSelector{Vec3(0, 0, 0), Vec3(1, 1.0 / 3, 1)};  // a third of the cube
  EXPECT_LT((total(force_of(load)) - 500.0 / 3 * Vec3(1, 2, 0)).norm(), 1e-10);
}

/// Where the density varies too.
TEST(Loads, OfAccelerationAreThoseOfGravity) {
  const auto cube = [](const Vec3& acceleration) {
    BodyInput body{cube_mesh(2), {}};
    RegionSettings light;
    light.box = BoxSelector{Vec3::Zero(), Vec3(0.5, 1, 1)};
    light.density = 100.0;
    body.settings.region.push_back(light);
    body.settings.load.emplace_back().acceleration = acceleration;
    return body;
  };
  const Vec3 g(1, -2, 3);
  const VecX loads = Model({cube(g)}, Vec3::Zero()).load_force(0.0);
  EXPECT_LT((loads - Model({cube(Vec3::Zero())}, g).gravity_force()).norm(), 1e-10);
}

TEST(Loads, OfTwoBodiesAreEachOnItsOwn) {
  BodyInput a{cube_mesh(1), {}}, b{cube_mesh(1), {}};
  b.settings.translate = Vec3(3, 0, 0);
  a.settings.load.emplace_back().force = Vec3(8, 0, 0);
  b.settings.load.emplace_back().force = Vec3(0, 16, 0);
  b.settings.load.back().top = 0.1;
  const VecX f = Model({a, b}, Vec3::Zero()).load_force(0.0);
  for (int v = 0; v < 8; ++v) EXPECT_EQ(Vec3(f.segment<3>(3 * v)), Vec3(1, 0, 0));
  EXPECT_EQ(total(f), Vec3(8, 16, 0));
  EXPECT_EQ(Model({BodyInput{cube_mesh(1), {}}}, Vec3::Zero()).load_force(0.0).size(), 0);
}

TEST(Loads, TellWhatIsWrong) {
  LoadSettings load;
  load.curve = {{1, 0}, {1, 2}};
  EXPECT_EQ(error_of([&] { force_of(load); }),
            "body 'body0': load 0: curve: time 1 must be later than the one before it");
  load = {};
  load.vertices = {0};
  load.traction = Vec3(1, 0, 0);
  EXPECT_EQ(error_of([&] { force_of(load); }),
            "body 'body0': load 0: traction and pressure need a boundary triangle with all corners selected");
  load.traction.setZero();
  load.acceleration = Vec3(1, 0, 0);
  EXPECT_EQ(error_of([&] { force_of(load); }),
            "body 'body0': load 0: body_force and acceleration need a tet with all corners selected");
  load.vertices = {99};
  EXPECT_EQ(error_of([&] { force_of(load); }),
            "body 'body0': load 0: vertex 99 is out of range; the body's vertices are 0 to 63");
}

}  // namespace loads_test
}  // namespace lagomorph::sim
