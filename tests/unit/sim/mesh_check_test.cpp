#include "sim/mesh_check.h"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace mesh_check_test {

std::string check_error(TetMesh mesh) {
  Remarks remarks;
  return error_of([&] { check_tet_mesh(mesh, "a.msh", remarks); });
}

Remarks remarks_of(TetMesh mesh) {
  Remarks remarks;
  check_tet_mesh(mesh, "a.msh", remarks);
  return remarks;
}

/// Appends another mesh's vertices and tets.
TetMesh joined(TetMesh a, const TetMesh& b, const Vec3& shift = Vec3::Zero()) {
  const int first = a.vertex_count();
  a.X.conservativeResize(first + b.X.rows(), 3);
  a.X.bottomRows(b.X.rows()) = b.X.rowwise() + shift.transpose();
  for (Tet tet : b.tets) {
    for (int& corner : tet) corner += first;
    a.tets.push_back(tet);
    a.tags.push_back(0);
  }
  a.bodies.clear();
  return a;
}

TEST(MeshCheck, GoodMeshesPassWithoutRemarks) {
  EXPECT_EQ(remarks_of(one_tet()), Remarks{});
  EXPECT_EQ(remarks_of(cube_mesh(3)), Remarks{});
}

TEST(MeshCheck, AnInvertedMeshIsTurned) {
  TetMesh mesh = cube_mesh(2);
  for (Tet& tet : mesh.tets) std::swap(tet[0], tet[1]);
  Remarks remarks;
  check_tet_mesh(mesh, "a.msh", remarks);
  EXPECT_EQ(remarks, Remarks{"a.msh: turned all 48 tets, which were inverted throughout"});
  EXPECT_NEAR(quality(mesh).volume, 1.0, 1e-14);
}

TEST(MeshCheck, SingleInvertedAndFlatTetsAreNamed) {
  TetMesh mesh = cube_mesh(2);
  for (const std::size_t j : {4u, 9u}) std::swap(mesh.tets[j][0], mesh.tets[j][1]);
  EXPECT_EQ(check_error(mesh),
            "a.msh: 2 of 48 tets inverted or flat (volume at most 1e-10 of the longest edge cubed), numbered "
            "from 0: 4 "
            "(-0.0208333 m^3), 9 (-0.0208333 m^3); all must have det[X1-X0, X2-X0, X3-X0] > 0");
  mesh = cube_mesh(2);
  for (std::size_t j = 10; j < 20; ++j) std::swap(mesh.tets[j][0], mesh.tets[j][1]);
  EXPECT_NE(check_error(mesh).find("10 of 48 tets inverted or flat"), std::string::npos);
  EXPECT_NE(check_error(mesh).find(", 14 (-0.0208333 m^3), ...;"), std::string::npos);
}

TEST(MeshCheck, FlatIsRelativeToTheSize) {
  for (const double size : {1e-6, 1.0, 1e6}) {
    TetMesh mesh = one_tet();
    mesh.X *= size;
    mesh.X(3, 2) = 1e-8 * size;  // a sliver, but 6e-10 of its edge cubed
    EXPECT_EQ(check_error(mesh), "no error") << size;
    mesh.X(3, 2) = 1e-9 * size;
    EXPECT_NE(check_error(mesh).find("1 of 1 tet inverted or flat"), std::string::npos) << size;
    mesh.X(3, 2) = -1e-9 * size;  // flat, so not turned
    EXPECT_NE(check_error(mesh).find("1 of 1 tet inverted or flat"), std::string::npos) << size;
  }
}

TEST(MeshCheck, WrongIndicesCountsAndNumbersAreTold) {
  TetMesh mesh = one_tet();
  mesh.tets[0][2] = -1;
  EXPECT_EQ(check_error(mesh), "a.msh: tet 0 (numbered from 0) has vertex -1; it must be in 0..3");
  mesh.tets[0][2] = 3;
  EXPECT_EQ(check_error(mesh),
            "a.msh: tet 0 (numbered from 0) has vertex 3 twice; its four corners must differ");
  mesh = one_tet();
  mesh.X(2, 1) = std::numeric_limits<double>::infinity();
  EXPECT_EQ(check_error(mesh),
            "a.msh: vertex 2 (numbered from 0) has the y coordinate inf; it must be finite");
  mesh = one_tet();
  mesh.tags.clear();
  EXPECT_EQ(check_error(mesh), "a.msh: 0 tags for 1 tets");
  mesh.tets.clear();
  EXPECT_EQ(check_error(mesh), "a.msh: no tetrahedra");
  mesh.X.resize(0, 3);
  EXPECT_EQ(check_error(mesh), "a.msh: no vertices");
}

TEST(MeshCheck, BodiesMustCoverTheMeshAndKeepApart) {
  TetMesh mesh = joined(one_tet(), one_tet(), Vec3(3, 0, 0));
  mesh.bodies = {{"a", {0, 4}, {0, 1}}, {"b", {4, 8}, {1, 2}}};
  EXPECT_EQ(check_error(mesh), "no error");
  mesh.bodies[1].tets.end = 1;
  EXPECT_EQ(check_error(mesh), "a.msh: the bodies have 8 vertices and 1 tets, the mesh 8 and 2");
  mesh.bodies[1] = {"b", {5, 8}, {1, 2}};
  EXPECT_EQ(check_error(mesh), "a.msh: the ranges of body 'b' do not follow those of the body before it");
  mesh.bodies[1] = {"b", {4, 8}, {1, 2}};
  mesh.tets[1][0] = 0;
  EXPECT_EQ(check_error(mesh), "a.msh: tet 1 of body 'b' has vertex 0 of another body");
}

TEST(MeshCheck, StrayVerticesAreNamedUpToFive) {
  TetMesh mesh = one_tet();
  mesh.bodies.clear();
  mesh.X.conservativeResize(11, 3);
  for (int i = 4; i < 11; ++i) mesh.X.row(i) << i, 5, 5;
  EXPECT_EQ(check_error(mesh),
            "a.msh: 7 stray vertices in no tet, numbered from 0: 4, 5, 6, 7, 8, ...; drop them with: "
            "lagomorph info a.msh --mend "
            "OUT.msh");
}

TEST(MeshCheck, DroppingStraysRenumbersTetsAndBodies) {
  TetMesh mesh = joined(one_tet(), one_tet(), Vec3(3, 0, 0));
  Points X(10, 3);
  X << mesh.X.topRows(2), Eigen::RowVector3d(7, 7, 7), mesh.X.middleRows(2, 6), Eigen::RowVector3d(8, 8, 8);
  const Points wanted = mesh.X;
  mesh.X = X;
  for (Tet& tet : mesh.tets) {
    for (int& corner : tet) corner += corner >= 2;
  }
  mesh.bodies = {{"a", {0, 5}, {0, 1}}, {"b", {5, 10}, {1, 2}}};
  EXPECT_EQ(drop_stray_vertices(mesh), 2);
  EXPECT_EQ(mesh.X, wanted);
  EXPECT_EQ(mesh.tets, (std::vector<Tet>{{0, 1, 2, 3}, {4, 5, 6, 7}}));
  EXPECT_EQ(mesh.bodies[0].vertices.end, 4);
  EXPECT_EQ(mesh.bodies[1].vertices.begin, 4);
  EXPECT_EQ(mesh.bodies[1].vertices.end, 8);
  EXPECT_EQ(check_error(mesh), "no error");
  EXPECT_EQ(drop_stray_vertices(mesh), 0);
}

TEST(MeshCheck, CoincidentVerticesAreRemarked) {
  TetMesh second = one_tet();
  second.X *= -1.0;  // shares the origin, which becomes -0 there; inverted, so turn it
  std::swap(second.tets[0][2], second.tets[0][3]);
  EXPECT_EQ(remarks_of(joined(one_tet(), second)),
            Remarks{"a.msh: 1 vertex coincides with another, the first pair 0 and 4 (numbered from 0); "
                    "bodies do not hold together "
                    "there"});
  const Remarks remarks = remarks_of(joined(cube_mesh(1), cube_mesh(1), Vec3(1, 0, 0)));
  EXPECT_EQ(remarks, Remarks{"a.msh: 4 vertices coincide with another, the first pair 1 and 8 (numbered from "
                             "0); bodies do not hold "
                             "together there"});
}

TEST(MeshCheck, OverlappingTetsAreAnError) {
  TetMesh mesh = joined(one_tet(), TetMesh{});
  mesh.tets.push_back({1, 2, 0, 3});  // the same again
  mesh.tags.push_back(0);
  EXPECT_EQ(check_error(mesh),
            "a.msh: tet 0 overlaps another: the face of vertices 1, 2, 3 (all numbered from 0) has two tets "
            "on the same side; is one "
            "there twice?");
  mesh.tets.push_back({0, 1, 2, 3});
  mesh.tags.push_back(0);
  EXPECT_EQ(check_error(mesh),
            "a.msh: tet 0 overlaps another: the face of vertices 1, 2, 3 (all numbered from 0) belongs to "
            "more than two tets; are some "
            "there twice?");
}

TEST(MeshCheck, SurfacesThatTouchThemselvesAreRemarked) {
  TetMesh mesh = joined(one_tet(), TetMesh{});
  mesh.X.conservativeResize(6, 3);
  mesh.X.row(4) << 0, -1, 0;
  mesh.X.row(5) << -1, 0, 0;
  mesh.tets.push_back({0, 5, 4, 3});  // shares the edge 0-3 only
  mesh.tags.push_back(0);
  Remarks remarks;
  check_tet_mesh(mesh, "a.msh", remarks);
  EXPECT_EQ(remarks, (Remarks{"a.msh: the surface is not manifold: 1 edge with more than two triangles, the "
                              "first from vertex 0 to 3 "
                              "(numbered from 0)"}));
  mesh.X.conservativeResize(7, 3);
  mesh.X.row(6) << -1, -1, -1;
  mesh.tets[1] = {0, 4, 5, 6};  // shares the vertex 0 only
  remarks.clear();
  check_tet_mesh(mesh, "a.msh", remarks);
  EXPECT_EQ(remarks,
            (Remarks{"a.msh: the surface touches itself at 1 vertex, the first 0 (numbered from 0)"}));
}

TEST(MeshCheck, BoundaryTrianglesAreOutwardInTheOrderOfTheTets) {
  EXPECT_EQ(boundary_triangles(one_tet(), {0, 1}),
            (std::vector<Triangle>{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}));
  const TetMesh mesh = cube_mesh(3);
  const std::vector<Triangle> all = boundary_triangles(mesh, {0, mesh.tet_count()});
  EXPECT_EQ(all.size(), 6u * 9u * 2u);
  double volume = 0.0;
  for (const Triangle& t : all) {
    const Vec3 A = mesh.X.row(t[0]), B = mesh.X.row(t[1]), C = mesh.X.row(t[2]);
    volume += A.dot(B.cross(C)) / 6.0;
  }
  EXPECT_NEAR(volume, 1.0, 1e-14);
  EXPECT_EQ(boundary_triangles(mesh, {6, 12}).size(), 12u);  // a cube of its own
}

TEST(MeshCheck, QualityOfTheRegularTet) {
  TetMesh mesh = one_tet();
  mesh.X << 1, 1, 1, -1, -1, 1, 1, -1, -1, -1, 1, -1;
  Remarks remarks;
  check_tet_mesh(mesh, "a.msh", remarks);
  const TetMeshQuality q = quality(mesh);
  EXPECT_NEAR(q.volume, 8.0 / 3.0, 1e-14);
  EXPECT_NEAR(q.min_dihedral_degrees, 70.528779365509308, 1e-9);  // acos(1/3)
  EXPECT_NEAR(q.max_dihedral_degrees, 70.528779365509308, 1e-9);
  EXPECT_NEAR(q.worst_radius_ratio, 1.0, 1e-14);
  EXPECT_EQ(q.volume_ratio, 1.0);
  EXPECT_EQ(q.min, Vec3(-1, -1, -1));
  EXPECT_EQ(q.max, Vec3(1, 1, 1));
  EXPECT_EQ(q.boundary_triangles, 4);
  EXPECT_TRUE(q.closed);
}

TEST(MeshCheck, QualityOfTheCornerTet) {
  // Unit tet: right angles at the corner, acos(1/√3) at the slanted face; r_in = 1/(3 + √3), r_circum = √3/2.
  TetMesh mesh = joined(one_tet(), one_tet(), Vec3(4, 0, 0));
  mesh.X.bottomRows(4) *= 2.0;
  const TetMeshQuality q = quality(mesh);
  EXPECT_NEAR(q.volume, 1.5, 1e-14);
  EXPECT_NEAR(q.volume_ratio, 0.125, 1e-14);
  EXPECT_NEAR(q.min_dihedral_degrees, 54.735610317245346, 1e-9);
  EXPECT_NEAR(q.max_dihedral_degrees, 90.0, 1e-9);
  EXPECT_NEAR(q.worst_radius_ratio, 3.0 / (3.0 + std::sqrt(3.0)) / (std::sqrt(3.0) / 2.0), 1e-14);
}

TriMesh octahedron() {
  TriMesh mesh;
  mesh.X.resize(6, 3);
  mesh.X << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return mesh;
}

Remarks surface_remarks(TriMesh& mesh) {
  Remarks remarks;
  check_tri_mesh(mesh, "a.obj", remarks);
  return remarks;
}

TEST(MeshCheck, AClosedSurfacePassesWithoutRemarks) {
  TriMesh mesh = octahedron();
  EXPECT_EQ(surface_remarks(mesh), Remarks{});
}

TEST(MeshCheck, OpenAndInconsistentSurfacesAreRemarked) {
  TriMesh mesh = octahedron();
  mesh.triangles.pop_back();
  EXPECT_EQ(surface_remarks(mesh), Remarks{"a.obj: the surface is not closed: 3 edges with one triangle, the "
                                           "first from vertex 0 to 3 (numbered from 0)"});
  mesh = octahedron();
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  EXPECT_EQ(
      surface_remarks(mesh),
      Remarks{"a.obj: the surface is not consistently oriented: 3 edges whose two triangles go the same "
              "way, the first from vertex 0 to 3 (numbered from 0)"});
}

TEST(MeshCheck, UselessTrianglesAndVerticesOfASurfaceGo) {
  TriMesh mesh = octahedron();
  mesh.triangles.push_back({1, 1, 4});
  Points X(7, 3);
  X << Eigen::RowVector3d(9, 9, 9), mesh.X;
  mesh.X = X;
  for (Triangle& triangle : mesh.triangles) {
    for (int& corner : triangle) ++corner;
  }
  EXPECT_EQ(surface_remarks(mesh), (Remarks{"a.obj: dropped 1 triangle with a corner twice",
                                            "a.obj: dropped 1 vertex of no triangle"}));
  EXPECT_EQ(mesh.X, octahedron().X);
  EXPECT_EQ(mesh.triangles, octahedron().triangles);
}

TEST(MeshCheck, TrianglesWithoutAreaAreRemarkedAndKept) {
  TriMesh mesh;
  mesh.X.resize(4, 3);
  mesh.X << 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0;
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
  const Remarks remarks = surface_remarks(mesh);
  ASSERT_FALSE(remarks.empty());
  EXPECT_EQ(remarks[0], "a.obj: 1 triangle without area, numbered from 0: 0");
  EXPECT_EQ(mesh.triangles.size(), 2u);
}

TEST(MeshCheck, UnusableSurfacesAreTold) {
  const auto error = [](TriMesh mesh) { return error_of([&] { surface_remarks(mesh); }); };
  TriMesh mesh = octahedron();
  mesh.triangles[3][1] = 6;
  EXPECT_EQ(error(mesh), "a.obj: triangle 3 (numbered from 0) has vertex 6; it must be in 0..5");
  mesh.triangles = {{1, 1, 2}};
  EXPECT_EQ(error(mesh), "a.obj: no triangles with three different corners");
  mesh.triangles.clear();
  EXPECT_EQ(error(mesh), "a.obj: no triangles");
}

TEST(MeshCheck, WeldMergesEqualPositionsOnly) {
  TriMesh mesh;
  mesh.X.resize(6, 3);
  mesh.X << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, -0.0, 0, -0.0, 1, 1e-300, 0;
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(weld(mesh), 2);
  EXPECT_EQ(mesh.X.rows(), 4);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 0, 3}}));
  EXPECT_EQ(mesh.X(3, 1), 1e-300);
  EXPECT_EQ(weld(mesh), 0);
}

}  // namespace mesh_check_test
}  // namespace lagomorph::sim
