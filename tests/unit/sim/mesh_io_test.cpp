#include "sim/mesh_io.h"

#include <clocale>
#include <cmath>
#include <locale>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "sim/mesh_check.h"
#include "sim/refine.h"
#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace mesh_io_test {

void expect_same(const TetMesh& a, const TetMesh& b) {
  EXPECT_EQ(a.X, b.X);
  EXPECT_EQ(a.tets, b.tets);
  EXPECT_EQ(a.tags, b.tags);
}

/// Positions with all their digits, of either sign, large and small.
TetMesh untidy_mesh() {
  TetMesh mesh = cube_mesh(2);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> shift(-0.05, 0.05);
  for (double& x : mesh.X.reshaped()) x = (x + shift(random)) * 1e-3 - 1.0 / 3.0;
  mesh.X(0, 0) = -1.0;
  mesh.tags[3] = -12;
  mesh.tags[4] = 2147483647;
  return mesh;
}

TriMesh untidy_surface() {
  TriMesh mesh;
  const TetMesh tets = untidy_mesh();
  mesh.X = tets.X;
  mesh.triangles = boundary_triangles(tets, {0, tets.tet_count()});
  Remarks remarks;
  check_tri_mesh(mesh, "surface", remarks);  // drops the vertex inside
  return mesh;
}

TEST(MeshIo, ReadsTheTruthBarTheSameFromMeditAndGmsh) {
  Remarks remarks;
  const TetMesh medit = read_tet_mesh(data_path("truth/bar.mesh"), remarks);
  const TetMesh gmsh = read_tet_mesh(data_path("truth/bar.msh"), remarks);
  EXPECT_EQ(remarks, Remarks{});
  EXPECT_EQ(medit.vertex_count(), 399);
  EXPECT_EQ(medit.tet_count(), 1243);
  expect_same(medit, gmsh);
  ASSERT_EQ(medit.bodies.size(), 1u);
  EXPECT_EQ(medit.bodies[0].name, "bar");
  for (int j = 0; j < medit.tet_count(); ++j) {
    const Tet& tet = medit.tets[static_cast<std::size_t>(j)];
    const double x =
        0.25 * (medit.X(tet[0], 0) + medit.X(tet[1], 0) + medit.X(tet[2], 0) + medit.X(tet[3], 0));
    EXPECT_EQ(medit.tags[static_cast<std::size_t>(j)], x < 0.5 ? 1 : 2) << "tet " << j;
  }
  EXPECT_NEAR(quality(medit).volume, 0.04, 1e-15);
}

/// Files of gmsh, VTK and meshio that hold the same mesh; see tests/data/meshes/make.sh.
class TwoBoxes : public testing::TestWithParam<const char*> {};

TEST_P(TwoBoxes, AreReadAlike) {
  Remarks remarks;
  const TetMesh mesh = read_tet_mesh(data_path("meshes/two_boxes_22.msh"), remarks);
  const TetMesh other = read_tet_mesh(data_path(std::string("meshes/two_boxes") + GetParam()), remarks);
  EXPECT_EQ(remarks, Remarks{});
  EXPECT_EQ(mesh.tet_count(), 48);
  ASSERT_EQ(mesh.X.rows(), other.X.rows());
  EXPECT_LT((mesh.X - other.X).cwiseAbs().maxCoeff(), 1e-14);  // some are written with fewer digits
  EXPECT_EQ(mesh.tets, other.tets);
  const bool elementary =
      std::string(GetParam()) == ".mesh";  // gmsh writes the volume's number there, not the physical tag
  for (int j = 0; j < other.tet_count(); ++j) {
    const Tet& tet = other.tets[static_cast<std::size_t>(j)];
    const double x =
        0.25 * (other.X(tet[0], 0) + other.X(tet[1], 0) + other.X(tet[2], 0) + other.X(tet[3], 0));
    EXPECT_EQ(other.tags[static_cast<std::size_t>(j)], elementary ? (x < 1 ? 1 : 2) : (x < 1 ? 11 : 5))
        << "tet " << j;
  }
}

INSTANTIATE_TEST_SUITE_P(MeshIo, TwoBoxes,
                         testing::Values(".mesh", "_22_binary.msh", "_41.msh", "_41_binary.msh", "_42.vtk",
                                         "_42_binary.vtk", "_51.vtk", "_51_binary.vtk", "_ascii.vtu",
                                         "_binary.vtu", "_binary_zlib.vtu", "_base64.vtu", "_base64_zlib.vtu",
                                         "_raw_big_endian.vtu", "_raw_zlib.vtu", "_meshio.vtu"),
                         [](const auto& info) {
                           std::string name = info.param;
                           for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

TEST(MeshIo, APartitionedMeshKeepsItsPhysicalTags) {
  Remarks remarks;
  const TetMesh mesh = read_tet_mesh(data_path("meshes/two_boxes_41_partitioned.msh"), remarks);
  EXPECT_EQ(mesh.tet_count(), 48);
  EXPECT_NEAR(quality(mesh).volume, 1.5, 1e-14);
  for (int j = 0; j < mesh.tet_count(); ++j) {
    const Tet& tet = mesh.tets[static_cast<std::size_t>(j)];
    const double x = 0.25 * (mesh.X(tet[0], 0) + mesh.X(tet[1], 0) + mesh.X(tet[2], 0) + mesh.X(tet[3], 0));
    EXPECT_EQ(mesh.tags[static_cast<std::size_t>(j)], x < 1 ? 11 : 5) << "tet " << j;
  }
}

/// Files of VTK and meshio with the surface of [-1, 1] x [-0.5, 0.5]^2, most with corners of their own for
/// each side.
class Cube : public testing::TestWithParam<const char*> {};

TEST_P(Cube, IsWeldedAndClosed) {
  Remarks remarks;
  const TriMesh mesh = read_tri_mesh(data_path(std::string("meshes/cube") + GetParam()), remarks);
  EXPECT_EQ(mesh.X.rows(), 8);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  for (const std::string& remark : remarks) EXPECT_NE(remark.find("welded"), std::string::npos) << remark;
  double volume = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 A = mesh.X.row(t[0]), B = mesh.X.row(t[1]), C = mesh.X.row(t[2]);
    volume += A.dot(B.cross(C)) / 6.0;
  }
  EXPECT_NEAR(volume, 2.0, 1e-14);
}

INSTANTIATE_TEST_SUITE_P(MeshIo, Cube,
                         testing::Values(".obj", ".off", "_ascii.ply", "_little_endian.ply",
                                         "_big_endian.ply", "_meshio.ply", "_ascii.stl", "_binary.stl"),
                         [](const auto& info) {
                           std::string name = info.param;
                           for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

TEST(MeshIo, EveryTetFormatReadsBackWhatItWrote) {
  const TetMesh mesh = untidy_mesh();
  const TempFolder folder;
  for (const std::string& extension : tet_mesh_extensions())
    folder.write("body" + extension, write_tet_mesh(mesh, extension));
  for (const std::string& extension : tet_mesh_extensions()) {
    SCOPED_TRACE(extension);
    Remarks remarks;
    const TetMesh read = read_tet_mesh(folder.path() / ("body" + extension), remarks);
    expect_same(read, mesh);
    EXPECT_EQ(remarks, Remarks{});
    ASSERT_EQ(read.bodies.size(), 1u);
    EXPECT_EQ(read.bodies[0].name, "body");
    EXPECT_EQ(read.bodies[0].vertices.end, mesh.vertex_count());
    EXPECT_EQ(read.bodies[0].tets.end, mesh.tet_count());
    EXPECT_EQ(write_tet_mesh(read, extension), write_tet_mesh(mesh, extension));
  }
}

TEST(MeshIo, QuadraticTetsReadBackAsTheyWereWritten) {
  const TetMesh mesh = with_quadratic_tets(untidy_mesh());
  const TempFolder folder;
  const std::vector<std::string> extensions = {".msh", ".node", ".ele", ".vtk", ".vtu"};
  for (const std::string& extension : extensions)
    folder.write("body" + extension, write_tet_mesh(mesh, extension));
  for (const std::string& extension : extensions) {
    SCOPED_TRACE(extension);
    Remarks remarks;
    const TetMesh read = read_tet_mesh(folder.path() / ("body" + extension), remarks);
    expect_same(read, mesh);
    EXPECT_EQ(read.midsides, mesh.midsides);
    EXPECT_EQ(remarks, Remarks{});
  }
  EXPECT_EQ(error_of([&] { write_tet_mesh(mesh, ".mesh"); }),
            "tetrahedral mesh to write as .mesh: it has 10-node tetrahedra, which are written as .msh, "
            ".node, .ele, "
            ".vtk or .vtu");
}

TEST(MeshIo, EveryTriFormatReadsBackWhatItWrote) {
  const TriMesh mesh = untidy_surface();
  const TempFolder folder;
  for (const std::string& extension : tri_mesh_extensions()) {
    SCOPED_TRACE(extension);
    Remarks remarks;
    const TriMesh read =
        read_tri_mesh(folder.write("surface" + extension, write_tri_mesh(mesh, extension)), remarks);
    ASSERT_EQ(read.X.rows(), mesh.X.rows());
    ASSERT_EQ(read.triangles.size(), mesh.triangles.size());
    // STL has no vertex numbers: the corners' positions are the same all the same.
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(read.X.row(read.triangles[t][k]), mesh.X.row(mesh.triangles[t][k]));
    }
    EXPECT_EQ(read.triangles == mesh.triangles, extension != ".stl");
  }
}

TEST(MeshIo, ReadersAndWritersDoNotKnowTheLocale) {
  // A decimal comma and grouped thousands, for C++ streams and, where the machine has such a locale, for C.
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const TetMesh mesh = untidy_mesh();
  const TriMesh surface = untidy_surface();
  std::vector<std::string> expected;
  for (const std::string& e : tet_mesh_extensions()) expected.push_back(write_tet_mesh(mesh, e));
  for (const std::string& e : tri_mesh_extensions()) expected.push_back(write_tri_mesh(surface, e));
  const TempFolder folder;
  for (std::size_t i = 0; i < tet_mesh_extensions().size(); ++i)
    folder.write("body" + tet_mesh_extensions()[i], expected[i]);

  const std::string c_locale = std::setlocale(LC_ALL, nullptr);
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) != nullptr) break;
  }
  std::size_t i = 0;
  for (const std::string& e : tet_mesh_extensions()) {
    EXPECT_EQ(write_tet_mesh(mesh, e), expected[i++]) << e;
    Remarks remarks;
    expect_same(read_tet_mesh(folder.path() / ("body" + e), remarks), mesh);
  }
  for (const std::string& e : tri_mesh_extensions())
    EXPECT_EQ(write_tri_mesh(surface, e), expected[i++]) << e;
  std::locale::global(before);
  std::setlocale(LC_ALL, c_locale.c_str());
}

TEST(MeshIo, WritesSeventeenDigitsAndTags) {
  TetMesh mesh = one_tet();
  mesh.X(0, 0) = -0.1;
  EXPECT_EQ(write_tet_mesh(mesh, ".msh"),
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 -0.10000000000000001 0 0\n2 1 0 0\n3 0 1 "
            "0\n4 0 0 1\n$EndNodes\n"
            "$Elements\n1\n1 4 2 7 1 1 2 3 4\n$EndElements\n");
}

TEST(MeshIo, WrittenMeshesAreCheckedToo) {
  TetMesh mesh = one_tet();
  mesh.tets[0] = {0, 1, 2, 4};
  EXPECT_EQ(error_of([&] { write_tet_mesh(mesh, ".vtu"); }),
            "tetrahedral mesh to write as .vtu: tet 0 (numbered from 0) has vertex 4; it must be in 0..3");
  mesh = cube_mesh(1);
  std::swap(mesh.tets[2][0], mesh.tets[2][1]);
  EXPECT_EQ(error_of([&] { write_tet_mesh(mesh, ".mesh"); }),
            "tetrahedral mesh to write as .mesh: 1 of 6 tets inverted or flat (volume at most 1e-10 of the "
            "longest edge cubed), "
            "numbered from 0: 2 (-0.166667 m^3); all must have det[X1-X0, X2-X0, X3-X0] > 0");
  EXPECT_NE(write_tet_mesh(mesh, ".mesh", {.orientation = false}), "");  // a deformed mesh may be so
  TriMesh surface;
  surface.X = Points::Constant(3, 3, std::nan(""));
  surface.triangles = {{0, 1, 2}};
  EXPECT_EQ(
      error_of([&] { write_tri_mesh(surface, ".ply"); }),
      "surface to write as .ply: vertex 0 (numbered from 0) has the x coordinate nan; it must be finite");
}

TEST(MeshIo, UnknownExtensionsAreToldWithTheValidOnes) {
  Remarks remarks;
  EXPECT_EQ(error_of([&] { read_tet_mesh("a.stl", remarks); }),
            "a.stl: unknown extension '.stl' for a tetrahedral mesh; valid are .mesh, .msh, .node, .ele, "
            ".vtk, .vtu");
  EXPECT_EQ(error_of([&] { read_tri_mesh("a.vtu", remarks); }),
            "a.vtu: unknown extension '.vtu' for a surface; valid are .obj, .off, .ply, .stl");
  EXPECT_EQ(error_of([&] { write_tet_mesh(one_tet(), "msh"); }),
            "tetrahedral mesh to write as msh: unknown extension 'msh' for a tetrahedral mesh; valid are "
            ".mesh, .msh, .node, .ele, "
            ".vtk, .vtu");
  EXPECT_EQ(tet_mesh_parts(".ele"), (std::vector<std::string>{".ele", ".node"}));
  EXPECT_EQ(tet_mesh_parts(".VTU"), std::vector<std::string>{".vtu"});
}

TEST(MeshIo, MissingFilesAndFoldersAreTold) {
  const TempFolder folder;
  Remarks remarks;
  EXPECT_EQ(error_of([&] { read_tet_mesh(folder.path() / "none.msh", remarks); }, folder.path()),
            "none.msh: cannot be read: No such file or directory");
  std::filesystem::create_directory(folder.path() / "folder.obj");
  EXPECT_EQ(error_of([&] { read_tri_mesh(folder.path() / "folder.obj", remarks); }, folder.path()),
            "folder.obj: is a directory, not a mesh file");
}

TEST(MeshIo, StrayVerticesAreRefusedUnlessTheyAreToBeDropped) {
  const TempFolder folder;
  TetMesh mesh = one_tet();
  const std::filesystem::path path = folder.write(
      "stray.mesh",
      replaced(replaced(write_tet_mesh(mesh, ".mesh"), "Vertices\n4\n", "Vertices\n5\n9 9 9 0\n"),
               "1 2 3 4 7", "2 3 4 5 7"));
  Remarks remarks;
  EXPECT_EQ(error_of([&] { read_tet_mesh(path, remarks); }, folder.path()),
            "stray.mesh: 1 stray vertex in no tet, numbered from 0: 0; drop them with: lagomorph info " +
                path.string() + " --mend OUT.msh");
  EXPECT_EQ(remarks, Remarks{});
  TetMesh kept = read_tet_mesh(path, remarks, {.strays = false});
  EXPECT_EQ(remarks, Remarks{path.string() + ": 1 stray vertex in no tet, numbered from 0: 0"});
  EXPECT_EQ(kept.vertex_count(), 5);
  EXPECT_EQ(drop_stray_vertices(kept), 1);
  expect_same(kept, mesh);
  EXPECT_EQ(kept.bodies[0].vertices.end, 4);
}

}  // namespace mesh_io_test
}  // namespace lagomorph::sim
