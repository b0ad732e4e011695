#include "sim/subdivision.h"

#include <cmath>
#include <map>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "sim/error.h"
#include "sim/surface.h"
#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace subdivision_test {

Points moved(const Subdivision& s, const Points& x) { return Points(s.stencil * x); }

/// Equilateral triangles with sides of 1 in the plane z = 0, (2 n + 1)^2 vertices, the middle one at the
/// origin.
struct Grid {
  explicit Grid(int n) : side(2 * n + 1), X(side * side, 3) {
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        X.row(at(i, j)) << (i - n) + 0.5 * (j - n), 0.5 * std::numbers::sqrt3 * (j - n), 0.0;
        if (i + 1 == side || j + 1 == side) continue;
        triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  int at(int i, int j) const { return j * side + i; }
  int side;
  Points X;
  std::vector<Triangle> triangles;
};

struct Solid {
  Points X;
  std::vector<Triangle> triangles;
};

/// On the unit sphere, outward.
Solid icosahedron() {
  const double p = std::numbers::phi;
  Solid solid{Points(12, 3), {}};
  solid.X << -1, p, 0, 1, p, 0, -1, -p, 0, 1, -p, 0, 0, -1, p, 0, 1, p, 0, -1, -p, 0, 1, -p, p, 0, -1, p, 0,
      1, -p, 0, -1, -p, 0, 1;
  solid.X.rowwise().normalize();
  solid.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return solid;
}

double volume_of(const Points& x, const std::vector<Triangle>& triangles) {
  double volume = 0.0;
  for (const Triangle& t : triangles) {
    const Vec3 A = x.row(t[0]), B = x.row(t[1]), C = x.row(t[2]);
    volume += A.dot(B.cross(C)) / 6.0;
  }
  return volume;
}

/// How often each directed edge is there.
std::map<std::pair<int, int>, int> sides_of(const std::vector<Triangle>& triangles) {
  std::map<std::pair<int, int>, int> sides;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
  return sides;
}

TEST(LoopSubdivision, WeightsAreThoseOfAMean) {
  const TetMesh mesh = cube_mesh(2);
  const Surface cube = Surface::boundary(mesh, 0);
  const Grid open(2);
  for (const auto& [triangles, count] :
       {std::pair(cube.triangles(), cube.vertex_count()), std::pair(open.triangles, open.side * open.side)}) {
    const Subdivision s = loop_subdivision(triangles, count, 3);
    EXPECT_EQ(s.triangles.size(), 64 * triangles.size());
    const VecX sums = s.stencil * VecX::Ones(count);
    EXPECT_LT((sums - VecX::Ones(sums.size())).cwiseAbs().maxCoeff(), 1e-14);
    for (int k = 0; k < s.stencil.outerSize(); ++k)
      for (decltype(s.stencil)::InnerIterator entry(s.stencil, k); entry; ++entry)
        EXPECT_GT(entry.value(), 0.0);
  }
  const Subdivision none = loop_subdivision(open.triangles, open.side * open.side, 0);
  EXPECT_EQ(none.triangles, open.triangles);
  EXPECT_EQ(moved(none, open.X), open.X);
}

TEST(LoopSubdivision, AFlatPatchStaysFlatAndItsRegularPartWhereItIs) {
  const Grid grid(3);
  const Subdivision s = loop_subdivision(grid.triangles, static_cast<int>(grid.X.rows()), 3);
  Points tilted = grid.X;
  tilted.col(2) = 0.3 * grid.X.col(0) - 0.7 * grid.X.col(1);
  const Points x = moved(s, tilted);
  EXPECT_LT((x.col(2) - 0.3 * x.col(0) + 0.7 * x.col(1)).cwiseAbs().maxCoeff(), 1e-14);
  // Linear functions are reproduced: vertices inside stay, new ones are on a finer grid.
  for (int j = 1; j + 1 < grid.side; ++j)
    for (int i = 1; i + 1 < grid.side; ++i)
      EXPECT_LT((x.row(grid.at(i, j)) - tilted.row(grid.at(i, j))).norm(), 1e-14);
  double area = 0.0;
  for (const Triangle& t : s.triangles) {
    const Vec3 A = x.row(t[0]), B = x.row(t[1]), C = x.row(t[2]);
    const double signed_area = 0.5 * (B - A).cross(C - A).z();
    EXPECT_GT(signed_area, 0.0);
    area += signed_area;
  }
  EXPECT_LT(area, 36.0 * 0.5 * std::numbers::sqrt3) << "its corners are cut by the border's curve";
}

/// Where six edges meet it is the box spline over three directions, each twice, whose values at the vertices
/// are 1/2 and 1/12 [de Boor, Hoellig, Riemenschneider 1993, "Box Splines"]. Old vertices come a quarter
/// nearer to it with each level.
TEST(LoopSubdivision, IsTheBoxSplineOfRegularMeshes) {
  const Grid grid(5);
  const int middle = grid.at(5, 5), beside = grid.at(6, 5), far = grid.at(7, 5), between = grid.at(6, 6);
  VecX one = VecX::Zero(grid.X.rows());
  one[middle] = 1.0;
  for (const int levels : {1, 2, 3, 4}) {
    const VecX b = loop_subdivision(grid.triangles, static_cast<int>(grid.X.rows()), levels).stencil * one;
    const double error = std::pow(0.25, levels);
    EXPECT_NEAR(b[middle], 0.5 + 0.5 * error, 1e-14) << levels;
    EXPECT_NEAR(b[beside], (1.0 - error) / 12.0, 1e-14) << levels;
    EXPECT_EQ(b[far], 0.0);
    EXPECT_EQ(b[between], 0.0);
    // Its mean is 1 a vertex: each level has four times as many.
    EXPECT_NEAR(b.sum(), std::pow(4.0, levels), 1e-12);
  }
}

/// Uniform cubic B-spline: 1/6, 2/3, 1/6 at its knots, and a level comes a quarter nearer.
TEST(LoopSubdivision, ABorderIsACubicBSpline) {
  const Grid grid(4);
  const int a = grid.at(3, 0), b = grid.at(4, 0), c = grid.at(5, 0), inside = grid.at(4, 1);
  for (const int levels : {1, 3}) {
    const Subdivision s = loop_subdivision(grid.triangles, static_cast<int>(grid.X.rows()), levels);
    const double error = std::pow(0.25, levels);
    EXPECT_NEAR(s.stencil.coeff(b, a), (1.0 - error) / 6.0, 1e-14);
    EXPECT_NEAR(s.stencil.coeff(b, b), 2.0 / 3.0 + error / 3.0, 1e-14);
    EXPECT_NEAR(s.stencil.coeff(b, c), (1.0 - error) / 6.0, 1e-14);
    EXPECT_EQ(s.stencil.coeff(b, inside), 0.0) << "what is inside does not pull at the border";
    EXPECT_EQ(s.open_edges, 4 * 8);
    EXPECT_EQ(s.crease_edges, 0);
  }
}

/// Its radius is that of the limit, in between the sphere through its vertices and the one it has inside, and
/// nearly the same all around; angles between triangles fall by half each level.
TEST(LoopSubdivision, AnIcosahedronBecomesRound) {
  const Solid solid = icosahedron();
  double before = 10.0;
  for (int levels = 1; levels <= 4; ++levels) {
    const Subdivision s = loop_subdivision(solid.triangles, 12, levels);
    const Points x = moved(s, solid.X);
    const auto sides = sides_of(s.triangles);
    for (const auto& [side, count] : sides) {
      EXPECT_EQ(count, 1);
      EXPECT_TRUE(sides.contains({side.second, side.first})) << "closed";
    }
    EXPECT_EQ(x.rows(), 2 + static_cast<Eigen::Index>(s.triangles.size()) / 2)
        << "a sphere by Euler's formula";
    EXPECT_GT(volume_of(x, s.triangles), 0.0) << "outward";
    double steepest = 0.0;
    std::map<std::pair<int, int>, Vec3> normals;
    for (const Triangle& t : s.triangles) {
      const Vec3 A = x.row(t[0]), B = x.row(t[1]), C = x.row(t[2]);
      const Vec3 n = (B - A).cross(C - A).normalized();
      EXPECT_GT(n.dot(A + B + C), 0.0);
      for (std::size_t k = 0; k < 3; ++k) normals[{t[k], t[(k + 1) % 3]}] = n;
    }
    for (const auto& [side, n] : normals) {
      const Vec3& other = normals.at({side.second, side.first});
      steepest = std::max(steepest, std::atan2(n.cross(other).norm(), n.dot(other)));
    }
    EXPECT_LT(steepest, 0.68 * before) << levels;
    before = steepest;
    if (levels < 4) continue;
    // The limit of a vertex of valence n: v + n chi (ring - v), 1 / chi = 3 / (8 b) + n [Loop 1987].
    const double c = 0.375 + 0.25 * std::cos(2.0 * std::numbers::pi / 5.0), b = (0.625 - c * c) / 5.0;
    const double chi = 1.0 / (0.375 / b + 5.0), ring = 1.0 / std::sqrt(5.0);  // the neighbours' height
    const double limit = 1.0 - 5.0 * chi * (1.0 - ring);
    EXPECT_NEAR(x.row(0).norm(), limit, 2e-3);
    const VecX radii = x.rowwise().norm();
    EXPECT_LT(radii.maxCoeff() / radii.minCoeff(), 1.02);
  }
}

/// Three triangles on one edge: it stays a curve of its own, here a straight one, and its ends stay.
TEST(LoopSubdivision, EdgesOfThreeTrianglesStay) {
  Points X(5, 3);
  X << 0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, -0.5, 0.8, 0.5, -0.5, -0.8;
  const Subdivision s = loop_subdivision({{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}, 5, 2);
  EXPECT_EQ(s.crease_edges, 1);
  EXPECT_EQ(s.open_edges, 6);
  const Points x = moved(s, X);
  EXPECT_LT((x.topRows(2) - X.topRows(2)).cwiseAbs().maxCoeff(), 1e-14) << "three creases meet at each end";
  ASSERT_EQ(s.edges.size(), 4U * 7U);
  for (std::size_t i = 0; i < 4; ++i)  // those of the edge from 0 to 1, the first
    for (const int v : s.edges[i]) EXPECT_LT(x.row(v).tail(2).norm(), 1e-14);
}

TEST(LoopSubdivision, CoarseEdgesRunFromEndToEnd) {
  const Solid solid = icosahedron();
  const Subdivision s = loop_subdivision(solid.triangles, 12, 3);
  ASSERT_EQ(s.edges.size(), 8U * 30U);
  const auto sides = sides_of(s.triangles);
  for (std::size_t i = 0; i < s.edges.size(); ++i) {
    const auto& [a, b] = s.edges[i];
    EXPECT_TRUE(sides.contains({a, b}));
    EXPECT_EQ(i % 8 == 0, a < 12);
    EXPECT_EQ(i % 8 == 7, b < 12);
    if (i % 8 != 0) {
      EXPECT_EQ(s.edges[i - 1][1], a);
    }
  }
}

/// What moves the coarse surface moves the fine one: the stencil times W.
TEST(LoopSubdivision, OfASurfaceFollowsTheTets) {
  const TetMesh mesh = cube_mesh(3);
  const Surface coarse = Surface::boundary(mesh, 0), fine = coarse.subdivided(2);
  EXPECT_EQ(fine.triangles().size(), 16 * coarse.triangles().size());
  const VecX q = as_q(mesh.X);
  VecX bent = q;
  for (Eigen::Index i = 0; i < bent.size(); i += 3) bent[i] += 0.2 * q[i + 1] * q[i + 1];
  const Subdivision direct = loop_subdivision(coarse.triangles(), coarse.vertex_count(), 2);
  EXPECT_LT((fine.positions(bent) - moved(direct, coarse.positions(bent))).cwiseAbs().maxCoeff(), 1e-14);
  const double volume = volume_of(fine.positions(q), fine.triangles());
  EXPECT_GT(volume, 0.9);
  EXPECT_LT(volume, 1.0) << "its edges are rounded";
  EXPECT_EQ(fine.open_edges(), 0);
  EXPECT_EQ(fine.first_cut_vertex(), fine.vertex_count());
}

TEST(LoopSubdivision, TooManyTrianglesAreRefused) {
  const std::vector<Triangle> many(20000, Triangle{0, 1, 2});
  try {
    loop_subdivision(many, 3, 4);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()),
              "4 subdivisions of 20000 triangles give 5120000; at most 4194304 can be drawn");
  }
}

}  // namespace subdivision_test
}  // namespace lagomorph::sim
