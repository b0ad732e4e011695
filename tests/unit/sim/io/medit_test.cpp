#include <gtest/gtest.h>

#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace medit_test {

const std::string kTet =
    "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\nTetrahedra\n1\n1 "
    "2 3 4 9\nEnd\n";

TEST(Medit, VariationsOfTheFormatAreRead) {
  const TetMesh mesh =
      tets_in("a.mesh",
              "# by hand\r\n MeshVersionFormatted\n1\n\nDimension\n3\r\nTetrahedra 2 # before its "
              "vertices\n1 2 3 4 -5\n2 3 4 5 6\nGeometry\n\"other.mesh\"\nVertices 5\n0 0 0 1\n+1 0 0 1\n0 "
              "1.E0 0 1\n0 0 .1e1 1\n1 1 1 1 Corners\n2\n1\n2\nTriangles\n1\n1 2 3 "
              "4\nRequiredTriangles\n1\n1\nEdges\n1\n1 2 3\nNormals\n1\n0 0 1\nNormalAtVertices\n1\n1 "
              "1\nAngleOfCornerBound\n46.3\nHexahedra\n0\nUnheardOf\n2\n1 2\n3 4\nTangents 0\n");
  EXPECT_EQ(mesh.vertex_count(), 5);
  EXPECT_EQ(mesh.tets, (std::vector<Tet>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(mesh.tags, (std::vector<int>{-5, 6}));
  EXPECT_EQ(mesh.X.row(2), Eigen::RowVector3d(0, 1, 0));
  EXPECT_EQ(mesh.X.row(3), Eigen::RowVector3d(0, 0, 1));
  EXPECT_EQ(tets_in("a.MESH", kTet).tags, std::vector<int>{9});
}

TEST(Medit, WhatIsWrongIsToldWithItsLine) {
  const auto error = [](std::string_view from, std::string_view to) {
    return tet_error("a.mesh", replaced(kTet, from, to));
  };
  EXPECT_EQ(error("1 2 3 4 9", "1 2 3 5 9"), "a.mesh:11: a vertex of a tetrahedron is 5; it must be in 1..4");
  EXPECT_EQ(error("1 2 3 4 9", "1 2 3 0 9"), "a.mesh:11: a vertex of a tetrahedron is 0; it must be in 1..4");
  EXPECT_EQ(error("1 2 3 4 9", "1 2 3 4.5 9"),
            "a.mesh:11: expected a vertex of a tetrahedron (an integer), found '4.5'");
  EXPECT_EQ(error("1 2 3 4 9", "1 2 3 4 99999999999"),
            "a.mesh:11: the region number 99999999999 does not fit 32 bits");
  EXPECT_EQ(error("0 1 0 0\n", "0 1.0D+00 0 0\n"),
            "a.mesh:7: '1.0D+00' has Fortran's exponent D; numbers are written as 1.0E+00");
  EXPECT_EQ(error("0 1 0 0\n", "0 1,5 0 0\n"),
            "a.mesh:7: '1,5' has a comma; numbers are written with a decimal point");
  EXPECT_EQ(error("0 1 0 0\n", "0 nan 0 0\n"), "a.mesh:7: 'nan' is not finite; a vertex coordinate must be");
  EXPECT_EQ(error("0 1 0 0\n", "0 -Inf 0 0\n"),
            "a.mesh:7: '-Inf' is not finite; a vertex coordinate must be");
  EXPECT_EQ(error("0 1 0 0\n", "0 1e999 0 0\n"), "a.mesh:7: '1e999' is out of range for a double");
  EXPECT_EQ(error("0 1 0 0\n", "0 0x1p0 0 0\n"),
            "a.mesh:7: expected a vertex coordinate (a number), found '0x1p0'");
  EXPECT_EQ(error("0 1 0 0\n", "0 1e-999 0 0\n"),
            "a.mesh: 1 of 1 tet inverted or flat (volume at most 1e-10 of the longest edge cubed), numbered "
            "from 0: 0 (0 m^3); all must have det[X1-X0, X2-X0, X3-X0] > 0");
  EXPECT_EQ(error("1 2 3 4 9\n", "1 2 3 4 \n"),
            "a.mesh:12: expected a tetrahedron's reference (an integer), found 'End'");
  EXPECT_EQ(
      error("Vertices\n4", "Vertices\n3"),
      "a.mesh:8: expected a section's keyword, found '0'; is the count of the section before it right?");
  EXPECT_EQ(error("Vertices\n4", "Vertices\n1000000000000"),
            "a.mesh:4: the number of Vertices is 1000000000000, more than the 60 bytes that follow can hold; "
            "the file is cut short or its count is wrong");
  EXPECT_EQ(error("Vertices\n4", "Vertices\n-4"),
            "a.mesh:4: the number of Vertices is -4; it cannot be negative");
  EXPECT_EQ(error("Dimension 3", "Dimension 2"), "a.mesh:2: the dimension is 2; it must be 3");
  EXPECT_EQ(error("Formatted 2", "Formatted 9"), "a.mesh:1: version 9; versions 0 to 4 can be read");
  EXPECT_EQ(error("MeshVersionFormatted", "solid"),
            "a.mesh:1: expected 'MeshVersionFormatted', found 'solid'");
  EXPECT_EQ(error("End\n", "Tetrahedra\n0\nEnd\n"), "a.mesh:12: a second section 'Tetrahedra'");
  EXPECT_EQ(error("Tetrahedra\n1\n1 2 3 4 9\n", ""),
            "a.mesh:9: no section 'Tetrahedra'; a surface cannot be simulated, a tetrahedral mesh is needed");
  EXPECT_EQ(error("1 2 3 4 9\nEnd\n", "1 2 3    "),
            "a.mesh:11: the file ends where a vertex of a tetrahedron should be");
  EXPECT_EQ(tet_error("a.mesh", ""), "a.mesh:1: the file ends where MeshVersionFormatted should be");
}

TEST(Medit, OtherVolumesAreNamed) {
  EXPECT_EQ(tet_error("a.mesh", replaced(kTet, "End", "Hexahedra\n1\n1 2 3 4 1 2 3 4 0\nEnd")),
            "a.mesh:13: 1 Hexahedra; only 4-node Tetrahedra can be used for volumes");
  EXPECT_EQ(tet_error("a.mesh", replaced(kTet, "End", "TetrahedraP2\n1\n1 2 3 4 1 2 3 4 1 2 0\nEnd")),
            "a.mesh:13: 1 TetrahedraP2; only 4-node Tetrahedra can be used for volumes");
}

TEST(Medit, SectionsThatAreSkippedAreCountedToo) {
  EXPECT_EQ(tet_error("a.mesh", replaced(kTet, "End", "Triangles\n2\n1 2 3 0\n1 2 3\nEnd")),
            "a.mesh:16: expected an entry of Triangles (a number), found 'End'");
}

}  // namespace medit_test
}  // namespace lagomorph::sim
