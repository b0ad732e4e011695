#include <gtest/gtest.h>

#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace vtk_test {

const std::string kTet =
    "# vtk DataFile Version 2.0\na title\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0\n0 1 "
    "0 0 0 1\nCELLS 2 9\n3 0 1 2\n4 0 1 2 3\nCELL_TYPES 2\n5 10\n";

TEST(Vtk, AttributesInAnyOrderAreSkippedAndTagsFound) {
  const std::string attributes =
      "POINT_DATA 4\nVECTORS v float\n1 2 3 1 2 3 1 2 3 1 2 3\nTENSORS t double\n1 0 0 0 1 0 0 0 1 1 0 0 0 1 "
      "0 0 0 1 1 0 0 0 1 0 0 0 1 1 0 0 0 1 0 0 0 1\nTEXTURE_COORDINATES uv 2 float\n0 0 0 1 1 0 1 "
      "1\nLOOKUP_TABLE colours 1\n0 0 0 1\nCELL_DATA 2\nSCALARS pressure float\nLOOKUP_TABLE default\n1.5 "
      "nan\nSCALARS two int 2\nLOOKUP_TABLE default\n1 2 3 4\nMETADATA\nINFORMATION 1\nNAME L2_NORM_RANGE "
      "LOCATION vtkDataArray\nDATA 2 0 1\n\nFIELD FieldData 3\nwords 1 2 string\nfirst "
      "word\nsecond\nCellEntityIds 1 2 int\n3 4\nMETADATA\nINFORMATION 0\n\nbits 3 2 bit\n0 1 0 1 1 "
      "1\nCOLOR_SCALARS c 3\n0 0 0 1 1 1\nglobal_ids ids vtkIdType\n0 1\n";
  EXPECT_EQ(tets_in("a.vtk", kTet).tags, std::vector<int>{0});
  EXPECT_EQ(tets_in("a.vtk", kTet + attributes).tags, std::vector<int>{4});
  EXPECT_EQ(tets_in("a.vtk", kTet + "CELL_DATA 2\nSCALARS tag int\n7 8\n").tags, std::vector<int>{8});
  // Of points, or of several components, it is none of ours.
  EXPECT_EQ(tets_in("a.vtk", kTet + "POINT_DATA 4\nSCALARS tag int\n7 8 9 10\n").tags, std::vector<int>{0});
  EXPECT_EQ(tets_in("a.vtk", kTet + "CELL_DATA 2\nSCALARS tag int 2\n7 8 9 10\n").tags, std::vector<int>{0});
}

TEST(Vtk, OffsetsAndConnectivityOfVersion5) {
  const std::string cells =
      "CELLS 3 7\nOFFSETS vtktypeint64\n0 3 7\nCONNECTIVITY vtktypeint64\n0 1 2 0 1 2 3\n";
  const std::string text =
      replaced(replaced(kTet, "CELLS 2 9\n3 0 1 2\n4 0 1 2 3\n", cells), "Version 2.0", "Version 5.1");
  EXPECT_EQ(tets_in("a.vtk", text).tets, one_tet().tets);
  EXPECT_EQ(tet_error("a.vtk", replaced(text, "0 3 7", "1 3 7")),
            "a.vtk:12: the first offset is 1; it must be 0");
  EXPECT_EQ(tet_error("a.vtk", replaced(text, "0 3 7", "0 3 8")),
            "a.vtk:14: cell 1 (numbered from 0) ends at 8 of the connectivity; it must be in 3..7");
  EXPECT_EQ(tet_error("a.vtk", replaced(text, "0 3 7", "0 4 7")),
            "a.vtk:14: cell 1 (numbered from 0), a tetrahedron, has 3 points; it must have 4");
}

TEST(Vtk, WhatIsWrongIsToldWithItsLine) {
  const auto error = [](std::string_view from, std::string_view to) {
    return tet_error("a.vtk", replaced(kTet, from, to));
  };
  EXPECT_EQ(error("# vtk DataFile", "# vtk Data"),
            "a.vtk:1: the first line must begin with '# vtk DataFile Version'");
  EXPECT_EQ(error("UNSTRUCTURED_GRID", "POLYDATA"),
            "a.vtk:4: the data set is 'POLYDATA'; an UNSTRUCTURED_GRID of tetrahedra is needed");
  EXPECT_EQ(error("ASCII", "TEXT"), "a.vtk:3: expected ASCII or BINARY, found 'text'");
  EXPECT_EQ(error("4 float", "4 quad"), "a.vtk:5: unknown data type 'quad'");
  EXPECT_EQ(error("4 float", "4000000000000 float"),
            "a.vtk:5: the number of points is 4000000000000, more than the 71 bytes that follow can hold; "
            "the file is cut short or its count is wrong");
  EXPECT_EQ(error("0 1 0 0 0 1", "0 1 0 0 0 inf"), "a.vtk:7: 'inf' is not finite; a coordinate must be");
  EXPECT_EQ(error("4 0 1 2 3", "4 0 1 2 4"),
            "a.vtk:12: cell 1 (numbered from 0) has point 4; it must be in 0..3");
  EXPECT_EQ(error("3 0 1 2\n", "5 0 1 2\n"),
            "a.vtk:10: cell 2 (numbered from 0) has 3 points where 0 numbers are left in CELLS");
  EXPECT_EQ(error("CELLS 2 9", "CELLS 1 9"), "a.vtk:10: CELLS says 1 cells, its numbers make 2");
  EXPECT_EQ(error("CELL_TYPES 2\n5 10\n", "CELL_TYPES 1\n10\n"), "a.vtk:12: 1 cell types for 2 cells");
  EXPECT_EQ(error("CELL_TYPES 2\n5 10\n", ""), "a.vtk:10: no CELL_TYPES");
  EXPECT_EQ(error("CELL_TYPES", "CELL_KINDS"), "a.vtk:11: unknown keyword 'cell_kinds'");
  EXPECT_EQ(tet_error("a.vtk", kTet + "CELL_DATA 3\nSCALARS tag int\n7 8 9\n"),
            "a.vtk:15: 3 tags for 2 cells");
  EXPECT_EQ(tet_error("a.vtk", kTet + "CELL_DATA 2\nSCALARS tag int\n7 8.5\n"),
            "a.vtk:15: expected tags (an integer), found '8.5'");
  EXPECT_EQ(tet_error("a.vtk", kTet + kTet.substr(kTet.find("POINTS"))), "a.vtk:13: a second section POINTS");
}

TEST(Vtk, OtherVolumesAreNamed) {
  EXPECT_EQ(tet_error("a.vtk", replaced(kTet, "\n5 10\n", "\n5 24\n")),
            "a.vtk:12: cell 1 (numbered from 0), a tetrahedron, has 4 points; it must have 10");
  EXPECT_EQ(tet_error("a.vtk", replaced(kTet, "\n5 10\n", "\n99 10\n")),
            "a.vtk:12: cell 0 (numbered from 0) is of type 99; only tetrahedra of 4 nodes (type 10) or 10 "
            "(type 24) can be used for volumes");
}

TEST(Vtk, ErrorsInBinaryFilesTellTheByte) {
  std::string bytes = "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 float\n";
  bytes += std::string("\x7f\xc0\0\0\0\0\0\0\0\0\0\0", 12);
  EXPECT_EQ(tet_error("a.vtk", bytes), "a.vtk: byte 77: a coordinate is nan; it must be finite");
}

}  // namespace vtk_test
}  // namespace lagomorph::sim
