#include "sim/surface.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "sim/mesh_check.h"
#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace surface_test {

VecX flat(const Points& x) { return as_q(x); }

/// x(X) = A X + t, which linear shape functions reproduce everywhere, outside of the tets too.
Points affine(const Points& X) {
  Mat3 A;
  A << 1.1, 0.2, -0.3, 0.05, 0.9, 0.4, -0.2, 0.1, 1.3;
  return (X * A.transpose()).rowwise() + Eigen::RowVector3d(0.5, -2.0, 3.0);
}

/// Volume enclosed by outward triangles: Σ A·(B×C)/6.
double enclosed_volume(const Points& x, const std::vector<Triangle>& triangles) {
  double volume = 0.0;
  for (const Triangle& t : triangles) {
    const Vec3 A = x.row(t[0]), B = x.row(t[1]), C = x.row(t[2]);
    volume += A.dot(B.cross(C)) / 6.0;
  }
  return volume;
}

TEST(Surface, BoundaryIsOutwardAndFollows) {
  const TetMesh mesh = cube_mesh(4);
  const Surface surface = Surface::boundary(mesh, 0);
  EXPECT_EQ(surface.triangles().size(), 6u * 16u * 2u);
  EXPECT_EQ(surface.vertex_count(), 125 - 27);
  EXPECT_NEAR(enclosed_volume(surface.positions(flat(mesh.X)), surface.triangles()), 1.0, 1e-14);
  const Points moved = surface.positions(flat(affine(mesh.X)));
  EXPECT_LT((moved - affine(surface.positions(flat(mesh.X)))).cwiseAbs().maxCoeff(), 1e-14);
}

/// A cut of the cube at x = 0.5 by whole tets: closed, outward, and the same volume as its tets'.
TEST(Surface, APartIsClosedAndItsCutHasCornersOfItsOwn) {
  const TetMesh mesh = cube_mesh(4);
  const Vec3 point(0.5, 0.5, 0.5), normal(-2.0, 0.0, 0.0);
  const TetMesh kept = kept_part(mesh, 0, point, normal);
  EXPECT_EQ(kept.tet_count(), mesh.tet_count() / 2);
  const Surface part = Surface::part(mesh, 0, kept);
  const Points x = part.positions(flat(mesh.X));
  EXPECT_NEAR(enclosed_volume(x, part.triangles()), 0.5, 1e-14);
  ASSERT_LT(part.first_cut_vertex(), part.vertex_count());
  for (int v = part.first_cut_vertex(); v < part.vertex_count(); ++v) EXPECT_NEAR(x(v, 0), 0.5, 1e-14);
  // Each corner of the cut is in one triangle alone, and no triangle has corners of both kinds.
  std::vector<int> uses(static_cast<std::size_t>(part.vertex_count()), 0);
  for (const Triangle& t : part.triangles()) {
    int of_cut = 0;
    for (const int v : t) {
      ++uses[static_cast<std::size_t>(v)];
      of_cut += v >= part.first_cut_vertex() ? 1 : 0;
    }
    EXPECT_TRUE(of_cut == 0 || of_cut == 3);
  }
  for (auto v = static_cast<std::size_t>(part.first_cut_vertex()); v < uses.size(); ++v)
    EXPECT_EQ(uses[v], 1);
  const Points moved = part.positions(flat(affine(mesh.X)));
  EXPECT_LT((moved - affine(x)).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Surface, APartOfEverythingOrNothing) {
  const TetMesh mesh = cube_mesh(2);
  const Surface all = Surface::part(mesh, 0, kept_part(mesh, 0, Vec3(-1, 0, 0), Vec3::UnitX()));
  const Surface boundary = Surface::boundary(mesh, 0);
  EXPECT_EQ(all.triangles(), boundary.triangles());
  EXPECT_EQ(all.first_cut_vertex(), all.vertex_count());
  EXPECT_EQ(boundary.first_cut_vertex(), boundary.vertex_count());
  const Surface none = Surface::part(mesh, 0, kept_part(mesh, 0, Vec3(2, 0, 0), Vec3::UnitX()));
  EXPECT_TRUE(none.triangles().empty());
  EXPECT_EQ(none.vertex_count(), 0);
}

TEST(Surface, BoundaryOfTheSecondBodyLeavesTheFirstAlone) {
  TetMesh mesh = cube_mesh(1);
  const TetMesh other = one_tet();
  const int vertices = mesh.vertex_count(), tets = mesh.tet_count();
  mesh.X.conservativeResize(vertices + 4, 3);
  mesh.X.bottomRows(4) = other.X.array() + 5.0;
  mesh.tets.push_back({vertices, vertices + 1, vertices + 2, vertices + 3});
  mesh.tags.push_back(1);
  mesh.bodies.push_back({"one", {vertices, vertices + 4}, {tets, tets + 1}});
  const Surface surface = Surface::boundary(mesh, 1);
  EXPECT_EQ(surface.triangles().size(), 4u);
  const Points x = surface.positions(flat(mesh.X));
  EXPECT_EQ(x, Points(other.X.array() + 5.0));
  EXPECT_NEAR(enclosed_volume(x, surface.triangles()), 1.0 / 6.0, 1e-13);
  EXPECT_EQ(error_of([&] { Surface::boundary(mesh, 2); }), "body 2 of a mesh with 2 bodies");
}

TEST(Surface, EmbeddedVerticesMoveWithTheirTets) {
  const TetMesh mesh = cube_mesh(3);
  TriMesh fine;
  fine.X.resize(200, 3);
  fine.X.setRandom();
  fine.X = 0.5 * (fine.X.array() + 1.0);
  fine.X.row(7) << 0.5, 0.5, 1.01;  // a little outside: extrapolated
  for (int i = 0; i + 2 < 200; ++i) fine.triangles.push_back({i, i + 1, i + 2});
  const Surface surface = Surface::embedded(mesh, 0, fine);
  EXPECT_EQ(surface.triangles(), fine.triangles);
  EXPECT_EQ(surface.outside_count(), 1);
  EXPECT_NEAR(surface.outside_distance(), 0.01, 1e-15);
  EXPECT_LT((surface.positions(flat(mesh.X)) - fine.X).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((surface.positions(flat(affine(mesh.X))) - affine(fine.X)).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(Surface, EmbeddedRefusesAVertexFarOutside) {
  const TetMesh mesh = cube_mesh(2);
  TriMesh fine;
  fine.X.resize(3, 3);
  fine.X << 0.5, 0.5, 0.5, 0.5, 1.25, 0.5, 0.1, 0.1, 0.1;
  fine.triangles = {{0, 1, 2}};
  EXPECT_EQ(error_of([&] { Surface::embedded(mesh, 0, fine); }),
            "vertex 1 (numbered from 0) of the fine surface at [0.5, 1.25, 0.5] is 0.25 m outside of the "
            "tets of body 'cube'; at "
            "most 0.0173205 m, 1 % of its size, can be carried");
  EXPECT_EQ(Surface::embedded(mesh, 0, fine, 0.2).outside_count(), 1);
}

TEST(Surface, PositionsNeedAllVertices) {
  const TetMesh mesh = one_tet();
  const Surface surface = Surface::boundary(mesh, 0);
  EXPECT_EQ(error_of([&] { surface.positions(VecX::Zero(9)); }), "positions of 3 vertices for a mesh of 4");
}

}  // namespace surface_test
}  // namespace lagomorph::sim
