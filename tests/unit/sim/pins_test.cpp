#include "sim/pins.h"

#include <gtest/gtest.h>

#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace pins_test {

TEST(Pins, DropTheirCoordinates) {
  const Pins pins(4, {2, 0, 2});
  EXPECT_EQ(pins.vertices(), (std::vector<int>{0, 2}));
  EXPECT_EQ(pins.free_vertices(), (std::vector<int>{1, 3}));
  EXPECT_EQ(pins.free_dofs(), 6);
  EXPECT_TRUE(pins.is_pinned(0));
  EXPECT_FALSE(pins.is_pinned(3));
  EXPECT_EQ(pins.free_index(3), 1);
  EXPECT_EQ(pins.free_index(2), -1);
}

TEST(Pins, MayHoldSingleAxes) {
  const Pins pins(std::vector<char>{1, 0, 1, 0, 0, 0, 1, 1, 1});
  EXPECT_EQ(pins.vertices(), (std::vector<int>{0, 2}));
  EXPECT_EQ(pins.free_vertices(), (std::vector<int>{0, 1}));
  EXPECT_EQ(pins.free_dofs(), 4);
  EXPECT_TRUE(pins.is_held(0));
  EXPECT_FALSE(pins.is_held(1));
  EXPECT_FALSE(pins.is_pinned(0));
  EXPECT_TRUE(pins.is_pinned(2));
  VecX expected(9);
  expected << 1, 0, 3, 0, 0, 0, 7, 8, 9;
  EXPECT_EQ(pins.pinned_part(VecX::LinSpaced(9, 1, 9)), expected);
}

class ProjectionOf : public testing::TestWithParam<Pins> {};

TEST_P(ProjectionOf, PinsIsThatOfTheirMatrix) {
  const Pins& pins = GetParam();
  const VecX q = VecX::LinSpaced(12, 1, 12);
  const SparseMatrix P = pins.matrix();
  EXPECT_EQ(pins.project(q), VecX(P * q));
  EXPECT_EQ(pins.expand(pins.project(q)), VecX(P.transpose() * (P * q)));
  VecX cleared = q;
  pins.clear_pinned(cleared);
  EXPECT_EQ(cleared, VecX(P.transpose() * (P * q)));
  EXPECT_DOUBLE_EQ(pins.free_norm(q), (P * q).norm());
}
INSTANTIATE_TEST_SUITE_P(Pins, ProjectionOf,
                         testing::Values(Pins(4, {0, 2}),
                                         Pins(std::vector<char>{1, 0, 1, 0, 0, 0, 1, 1, 1, 0, 1, 0})));

/// q = Pᵀ q_free + b with b the pinned positions.
TEST(Pins, PartAPositionIntoFreeAndPinned) {
  const Pins pins(4, {1});
  const VecX q = VecX::LinSpaced(12, 1, 12);
  VecX b = VecX::Zero(12);
  b.segment<3>(3) = q.segment<3>(3);
  EXPECT_EQ(VecX(pins.expand(pins.project(q)) + b), q);
}

TEST(Pins, MayHoldNothingOrAll) {
  EXPECT_EQ(Pins(3, {}).free_dofs(), 9);
  EXPECT_EQ(Pins(3, {0, 1, 2}).free_dofs(), 0);
  EXPECT_EQ(Pins(3, {0, 1, 2}).free_norm(VecX::Ones(9)), 0.0);
}

/// The selection among the vertices of the unit cube, 8 of them: x fastest, then y, then z.
std::vector<int> select(const PinSettings& pin) { return select_vertices(cube_mesh(1).X, pin, "here"); }

TEST(SelectVertices, ByIndex) {
  PinSettings pin;
  pin.vertices = {7, 0, 7};
  EXPECT_EQ(select(pin), (std::vector<int>{0, 7}));
}

TEST(SelectVertices, ByBoxWithItsBorder) {
  PinSettings pin;
  pin.box = BoxSelector{Vec3(0, 0, 0), Vec3(1, 0, 0.5)};
  EXPECT_EQ(select(pin), (std::vector<int>{0, 1}));
}

TEST(SelectVertices, BySphereWithItsBorder) {
  PinSettings pin;
  pin.sphere = SphereSelector{Vec3(0, 0, 0), 1.0};
  EXPECT_EQ(select(pin), (std::vector<int>{0, 1, 2, 4}));
}

TEST(SelectVertices, ByPlaneOnTheSideOfItsNormal) {
  PinSettings pin;
  pin.plane = PlaneSelector{Vec3(0.5, 0, 0), Vec3(-3, 0, 0)};
  EXPECT_EQ(select(pin), (std::vector<int>{0, 2, 4, 6}));
}

TEST(SelectVertices, ByTopAndBottom) {
  PinSettings top, bottom, whole;
  top.top = 0.1;
  bottom.bottom = 0.1;
  whole.top = 1.0;
  EXPECT_EQ(select(top), (std::vector<int>{2, 3, 6, 7}));
  EXPECT_EQ(select(bottom), (std::vector<int>{0, 1, 4, 5}));
  EXPECT_EQ(select(whole).size(), 8u);
}

TEST(SelectVertices, TopAndBottomIncludeTheirBorder) {
  Points X(5, 3);
  for (int v = 0; v < 5; ++v) X.row(v) = Vec3(0, 0.3 + 0.1 * v, 0);
  PinSettings pin;
  pin.top = 0.25;
  EXPECT_EQ(select_vertices(X, pin, "here"), (std::vector<int>{3, 4}));
}

TEST(SelectVertices, TakesTheUnion) {
  PinSettings pin;
  pin.vertices = {5};
  pin.box = BoxSelector{Vec3(0, 0, 0), Vec3(0, 0, 0)};
  pin.top = 0.5;
  EXPECT_EQ(select(pin), (std::vector<int>{0, 2, 3, 5, 6, 7}));
}

TEST(SelectVertices, TellsWhatIsWrong) {
  const auto error = [](auto change) {
    PinSettings pin;
    change(pin);
    return error_of([&] { select(pin); });
  };
  using P = PinSettings;
  EXPECT_EQ(error([](P&) {}), "here: selects nothing; give vertices, box, sphere, plane, top or bottom");
  EXPECT_EQ(error([](P& p) { p.vertices = {8}; }),
            "here: vertex 8 is out of range; the body's vertices are 0 to 7");
  EXPECT_EQ(error([](P& p) { p.vertices = {-1}; }),
            "here: vertex -1 is out of range; the body's vertices are 0 to 7");
  EXPECT_EQ(error([](P& p) {
              p.box = BoxSelector{Vec3(2, 0, 0), Vec3(3, 1, 1)};
            }),
            "here: box [2, 0, 0] to [3, 1, 1] selects none of the 8 vertices; the placed body spans [0, 0, "
            "0] to [1, 1, 1]");
  EXPECT_EQ(error([](P& p) {
              p.box = BoxSelector{Vec3(1, 0, 0), Vec3(0, 1, 1)};
            }),
            "here: box from [1, 0, 0] to [0, 1, 1] is empty; give the smaller corner first");
  EXPECT_EQ(
      error([](P& p) {
        p.sphere = SphereSelector{Vec3(0, 0, 0), -1.0};
      }),
      "here: sphere with centre [0, 0, 0] and radius -1 is none; the radius must be >= 0 and all be finite");
  EXPECT_EQ(error([](P& p) {
              p.sphere = SphereSelector{Vec3(0.5, 0.5, 0.5), 0.1};
            }),
            "here: sphere around [0.5, 0.5, 0.5] of radius 0.1 selects none of the 8 vertices; "
            "the placed body spans [0, 0, 0] to [1, 1, 1]");
  EXPECT_EQ(error([](P& p) {
              p.plane = PlaneSelector{Vec3(0, 0, 0), Vec3(0, 0, 0)};
            }),
            "here: plane through [0, 0, 0] with normal [0, 0, 0] is none; the normal must not be zero and "
            "all be finite");
  EXPECT_EQ(error([](P& p) {
              p.plane = PlaneSelector{Vec3(2, 0, 0), Vec3(1, 0, 0)};
            }),
            "here: plane through [2, 0, 0] with normal [1, 0, 0] selects none of the 8 vertices; "
            "the placed body spans [0, 0, 0] to [1, 1, 1]");
  EXPECT_EQ(error([](P& p) { p.top = 0.0; }), "here: top = 0 must be in (0, 1]");
  EXPECT_EQ(error([](P& p) { p.bottom = 1.5; }), "here: bottom = 1.5 must be in (0, 1]");
}

}  // namespace pins_test
}  // namespace lagomorph::sim
