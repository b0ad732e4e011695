#include <gtest/gtest.h>

#include "sim/io/base64.h"
#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace vtu_test {

const std::string kPiece =
    "<Piece NumberOfPoints=\"4\" NumberOfCells=\"2\">\n<PointData/>\n<CellData Scalars=\"tag\">\n"
    "<DataArray type=\"Int32\" Name=\"tag\" format=\"ascii\">3 -4</DataArray>\n</CellData>\n<Points>\n"
    "<DataArray type=\"Float32\" Name=\"p\" NumberOfComponents=\"3\" format=\"ascii\">\n0 0 0 1 0 0\n0 1 0 0 "
    "0 1\n</DataArray>\n"
    "</Points>\n<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 0 1 2 "
    "3</DataArray>\n"
    "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3 7</DataArray>\n"
    "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5 10</DataArray>\n</Cells>\n</Piece>\n";
const std::string kHead =
    "<?xml version=\"1.0\"?>\n<!-- by hand -->\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
    "byte_order=\"LittleEndian\">\n"
    "<UnstructuredGrid>\n";
const std::string kFoot = "</UnstructuredGrid>\n</VTKFile>\n";
const std::string kTet = kHead + kPiece + kFoot;

TEST(Vtu, PiecesAreJoined) {
  const TetMesh mesh = tets_in("a.vtu", kTet);
  EXPECT_EQ(mesh.X, one_tet().X);
  EXPECT_EQ(mesh.tets, one_tet().tets);
  EXPECT_EQ(mesh.tags, std::vector<int>{-4});
  const std::string moved = replaced(kPiece, "\n0 0 0 1 0 0\n0 1 0 0 0 1\n", "5 0 0 6 0 0\n5 1 0 5 0 1");
  const std::string empty = "<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"/>\n";
  const TetMesh two = tets_in("a.vtu", "\xef\xbb\xbf" + kHead + kPiece + empty + moved + kFoot);
  EXPECT_EQ(two.tets, (std::vector<Tet>{{0, 1, 2, 3}, {4, 5, 6, 7}}));
  EXPECT_EQ(two.X(5, 0), 6.0);
}

TEST(Vtu, WhatIsWrongIsToldWithItsLine) {
  const auto error = [](std::string_view from, std::string_view to) {
    return tet_error("a.vtu", replaced(kTet, from, to));
  };
  EXPECT_EQ(error("0 1 0 0 0 1\n", "0 1 0 0 0 nan\n"), "a.vtu:13: 'nan' is not finite; a value must be");
  EXPECT_EQ(error("0 1 0 0 0 1\n", "0 1 0 0 0\n"), "a.vtu:14: the file ends where a value should be");
  EXPECT_EQ(error("0 1 0 0 0 1\n", "0 1 0 0 0 1 2\n"),
            "a.vtu:11: array 'p' has more values than the 12 that it must have");
  EXPECT_EQ(error("0 1 2 0 1 2 3", "0 1 2 0 1 2 4"),
            "a.vtu:5: cell 1 (numbered from 0) has point 4; it must be in 0..3");
  EXPECT_EQ(error("\"4\"", "\"400000000\""),
            "a.vtu:11: array 'p' must have 1200000000 values, more than its text can hold");
  EXPECT_EQ(error("\"4\"", "\"4000000000000\""),
            "a.vtu:5: NumberOfPoints is '4000000000000'; it must be a number of less than ten digits");
  EXPECT_EQ(error(">3 7<", ">3 -7<"), "a.vtu:18: the last offset is -7, out of range");
  EXPECT_EQ(error(">3 7<", ">8 7<"),
            "a.vtu:5: cell 0 (numbered from 0) ends at 8 of the connectivity; it must be in 0..7");
  EXPECT_EQ(error("\"Int32\"", "\"Int31\""), "a.vtu:8: array 'tag' is of type 'Int31', which is unknown");
  EXPECT_EQ(error("NumberOfComponents=\"3\"", ""), "a.vtu:11: the points must have NumberOfComponents=\"3\"");
  EXPECT_EQ(error("\"UnstructuredGrid\"", "\"PolyData\""),
            "a.vtu:3: the type is 'PolyData'; it must be UnstructuredGrid");
  EXPECT_EQ(error("LittleEndian", "MiddleEndian"),
            "a.vtu:3: byte_order is 'MiddleEndian'; it must be LittleEndian or BigEndian");
  EXPECT_EQ(error("version=\"0.1\"", "header_type=\"Int8\""),
            "a.vtu:3: header_type is 'Int8'; it must be UInt32 or UInt64");
  EXPECT_EQ(error("\"types\"", "\"kinds\""), "a.vtu:16: no DataArray 'types' in Cells");
  EXPECT_EQ(error("<Points>", "<Dots>").substr(0, 36), "a.vtu:15: the XML is not well-formed");
  EXPECT_EQ(tet_error("a.vtu", "<a></a>"), "a.vtu:1: no element VTKFile");
  EXPECT_EQ(tet_error("a.vtu", "").substr(0, 35), "a.vtu:1: the XML is not well-formed");
}

TEST(Vtu, OtherVolumesAndCompressorsAreNamed) {
  EXPECT_EQ(tet_error("a.vtu", replaced(kTet, ">5 10<", ">5 12<")),
            "a.vtu:5: cell 1 (numbered from 0) is of type 12 (8-node hexahedron); only tetrahedra of 4 "
            "nodes (type 10) or 10 (type 24) can be used for volumes");
  Remarks remarks;
  EXPECT_EQ(
      error_of([&] { read_tet_mesh(data_path("meshes/two_boxes_lz4.vtu"), remarks); }, data_path("meshes")),
      "two_boxes_lz4.vtu:2: compressor is 'vtkLZ4DataCompressor'; vtkZLibDataCompressor or none can be read");
}

/// The header of a base64 array, UInt32.
std::string base64_of(std::initializer_list<std::uint32_t> sizes, std::string_view data) {
  std::string bytes;
  for (const std::uint32_t size : sizes) bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
  return io::base64_encode(bytes + std::string(data));
}

TEST(Vtu, SizesOfEncodedArraysAreChecked) {
  const auto tags = [](const std::string& text, const std::string& attributes = "") {
    std::string file = replaced(kTet, "format=\"ascii\">3 -4<", "format=\"binary\">" + text + "<");
    if (!attributes.empty()) file = replaced(file, "version=\"0.1\"", attributes);
    return file;
  };
  const std::string values("\3\0\0\0\4\0\0\0", 8);
  EXPECT_EQ(tets_in("a.vtu", tags(base64_of({8}, values))).tags, std::vector<int>{4});
  // The header may be encoded by itself, and blanks are nothing.
  EXPECT_EQ(tets_in("a.vtu", tags(" " + base64_of({8}, "") + "\n " + io::base64_encode(values))).tags,
            std::vector<int>{4});
  EXPECT_EQ(tet_error("a.vtu", tags(base64_of({4}, values))),
            "a.vtu:8: array 'tag' has 4 bytes; it must have 8");
  EXPECT_EQ(tet_error("a.vtu", tags(base64_of({8}, values.substr(1)))),
            "a.vtu:8: array 'tag' is cut short or no base64");
  EXPECT_EQ(tet_error("a.vtu", tags("CAAA!")), "a.vtu:8: array 'tag' is cut short or no base64");
  const std::string zlib = "compressor=\"vtkZLibDataCompressor\"";
  const std::string plain("\x78\x01\x01\x08\x00\xf7\xff\x03\x00\x00\x00\x04\x00\x00\x00\x00\x30\x00\x08",
                          19);  // a stored block
  EXPECT_EQ(tets_in("a.vtu", tags(base64_of({1, 8, 0, 19}, plain), zlib)).tags, std::vector<int>{4});
  EXPECT_EQ(tet_error("a.vtu", tags(base64_of({1, 8, 0, 19}, plain.substr(0, 18) + "x"), zlib)),
            "a.vtu:8: array 'tag': block 0 of its compressed data cannot be decompressed");
  EXPECT_EQ(tet_error("a.vtu", tags(base64_of({1, 4000000000u, 0, 19}, plain), zlib)),
            "a.vtu:8: array 'tag' is cut short or no base64");
  EXPECT_EQ(tet_error("a.vtu", tags(base64_of({4000000000u, 8, 0, 19}, plain), zlib)),
            "a.vtu:8: array 'tag' is cut short or no base64");
}

TEST(Vtu, NumbersInBinaryArraysAreChecked) {
  std::string values(96, '\0');
  values[7] = '\x7f';
  values[6] = '\xf0';  // infinity
  std::string file = replaced(
      kTet,
      "type=\"Float32\" Name=\"p\" NumberOfComponents=\"3\" format=\"ascii\">\n0 0 0 1 0 0\n0 1 0 0 0 1\n<",
      "type=\"Float64\" Name=\"p\" NumberOfComponents=\"3\" format=\"binary\">" + base64_of({96}, values) +
          "<");
  EXPECT_EQ(tet_error("a.vtu", file), "a.vtu:11: array 'p': byte 0: a value is infinite; it must be finite");
}

TEST(Vtu, AppendedDataNeedTheirUnderscoreAndOffset) {
  const std::string file =
      replaced(kTet, "format=\"ascii\">3 -4</DataArray>", "format=\"appended\" offset=\"77\"/>");
  EXPECT_EQ(tet_error("a.vtu", file), "a.vtu:8: the offset '77' is outside of the appended data");
  EXPECT_EQ(tet_error("a.vtu", replaced(file, "</VTKFile>",
                                        "<AppendedData encoding=\"raw\">\n</AppendedData></VTKFile>")),
            "a.vtu:23: AppendedData has no data; an underscore begins them");
}

}  // namespace vtu_test
}  // namespace lagomorph::sim
