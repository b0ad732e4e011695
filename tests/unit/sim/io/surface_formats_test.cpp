#include <cstdint>

#include <gtest/gtest.h>

#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace surface_formats_test {

using Triangles = std::vector<Triangle>;

const std::string kSquare = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST(Obj, CornersOfEachKindAndContinuedLines) {
  const TriMesh mesh =
      triangles_in("a.obj",
                   "# a comment\nmtllib a.mtl\no thing\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 0.5 0.5 0.5\nv 0 1 "
                   "0\nvt 0 0\nvn 0 0 1\ng a b\nusemtl red\ns off\nf 1 2/1 3/1/1 4//1\nl 1 2\nv 0 0 "
                   "1\r\n\r\nf -1 \\\n-5 \\\r\n-4\nf 5//-1 3/-1/-1 4 # end\n");
  EXPECT_EQ(mesh.X.rows(), 5);
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {4, 0, 1}, {4, 2, 3}}));
}

TEST(Obj, WhatIsWrongIsToldWithItsLine) {
  const auto error = [](const std::string& line) {
    return tri_error("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + line);
  };
  EXPECT_EQ(error("f 1 2 3\n"), "no error");
  EXPECT_EQ(error("f 1 2 4\n"),
            "a.obj:4: a face's vertex is 4; it must be in 1..3 or -3..-1, the vertices so far");
  EXPECT_EQ(error("f 1 2 0\n"),
            "a.obj:4: a face's vertex is 0; it must be in 1..3 or -3..-1, the vertices so far");
  EXPECT_EQ(error("f 1 2 -4\n"),
            "a.obj:4: a face's vertex is -4; it must be in 1..3 or -3..-1, the vertices so far");
  EXPECT_EQ(error("f 1 2\n"), "a.obj:4: a face of 2 corners; it must have 3 to 1000");
  for (const std::string corner : {"x", "1/", "1//", "1/x", "1/2/", "1/2/3/4", "/1", "1.5"}) {
    EXPECT_EQ(error("f 1 2 " + corner + "\n"),
              "a.obj:4: expected a face's corner such as 1, 1/2, 1//3 or 1/2/3, found '" + corner + "'");
  }
  EXPECT_EQ(error("v 1 2\nf 1 2 3\n"), "a.obj:5: expected a vertex coordinate (a number), found 'f'");
  EXPECT_EQ(error("v 1 2 nan\n"), "a.obj:4: 'nan' is not finite; a vertex coordinate must be");
  EXPECT_EQ(error("surf 0 1\n"),
            "a.obj:4: unknown statement 'surf'; vertices (v) and polygons (f) can be read");
  EXPECT_EQ(error(""), "a.obj: no triangles");
  EXPECT_EQ(tri_error("a.obj", ""), "a.obj: no vertices");
}

TEST(Polygons, ThatAreConcaveAreCutIntoEars) {
  // An L, from each of its corners: its two arms have 3 squares together, whichever corner comes first.
  const double L[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  for (int first = 0; first < 6; ++first) {
    std::string text;
    for (int i = 0; i < 6; ++i) {
      const double* x = L[(first + i) % 6];
      text +=
          "v " + std::to_string(x[0]) + " " + std::to_string(x[1]) + " " + std::to_string(x[0] + x[1]) + "\n";
    }
    const TriMesh mesh = triangles_in("a.obj", text + "f 1 2 3 4 5 6\n");
    ASSERT_EQ(mesh.triangles.size(), 4u);
    double area = 0.0;
    for (const Triangle& t : mesh.triangles) {
      const auto A = mesh.X.row(t[0]), B = mesh.X.row(t[1]), C = mesh.X.row(t[2]);
      const double twice = (B[0] - A[0]) * (C[1] - A[1]) - (B[1] - A[1]) * (C[0] - A[0]);  // seen along z
      EXPECT_GT(twice, 0.0) << "a triangle is turned over or flat";
      area += 0.5 * twice;
    }
    EXPECT_NEAR(area, 3.0, 1e-12);
  }
}

TEST(Off, HeadersWithColoursAndNormals) {
  const Triangles two{{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(triangles_in("a.off", "OFF\n# comment\n4 1 0\n" + kSquare + "4 0 1 2 3 255 0 0\n").triangles,
            two);
  EXPECT_EQ(triangles_in("a.off", "OFF 4 2\n" + kSquare + "3 0 1 2 0.5\n3 0 2 3\n").triangles, two);
  const std::string coloured =
      "0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n1 1 0 255 0 0 255\n0 1 0 255 0 0 255\n4 0 1 2 3\n";
  for (const std::string header : {"COFF", "NOFF", "CNOFF", "STOFF", "STCNOFF"}) {
    const TriMesh mesh = triangles_in("a.off", header + "\n4 1 0\n" + coloured);
    EXPECT_EQ(mesh.triangles, two);
    EXPECT_EQ(mesh.X.row(3), Eigen::RowVector3d(0, 1, 0));
  }
}

TEST(Off, WhatIsWrongIsToldWithItsLine) {
  const std::string off = "OFF\n4 1 0\n" + kSquare + "4 0 1 2 3\n";
  const auto error = [&](std::string_view from, std::string_view to) {
    return tri_error("a.off", replaced(off, from, to));
  };
  EXPECT_EQ(error("OFF", "4OFF"),
            "a.off:1: the header is '4OFF'; OFF, COFF, NOFF, CNOFF and STOFF can be read");
  EXPECT_EQ(error("OFF", "PLY"),
            "a.off:1: the header is 'PLY'; OFF, COFF, NOFF, CNOFF and STOFF can be read");
  EXPECT_EQ(error("OFF\n", "OFF BINARY\n"), "a.off:1: binary OFF; only ASCII can be read");
  EXPECT_EQ(error("1 1 0\n", "1 1 0 9 9 9\n"),
            "a.off:5: unexpected '9' after a vertex; a vertex with a colour needs the header COFF");
  EXPECT_EQ(error("4 0 1 2 3", "4 0 1 2 4"), "a.off:7: a face's vertex is 4; it must be in 0..3");
  EXPECT_EQ(error("4 0 1 2 3", "2 0 1"), "a.off:7: a face of 2 corners; it must have 3 to 1000");
  EXPECT_EQ(error("4 1 0\n", "4 2 0\n"),
            "a.off:8: the file ends where the number of corners of a face should be");
  EXPECT_EQ(error("4 1 0\n", "3 1 0\n"), "a.off:6: a face of 0 corners; it must have 3 to 1000");
  EXPECT_EQ(error("4 0 1 2 3\n", "4 0 1 2 3\n3 0 1 2\n"),
            "a.off:8: unexpected '3' after the last of 1 faces");
  EXPECT_EQ(error("4 1 0\n", "4 1000000000 0\n"),
            "a.off:2: the number of faces is 1000000000, more than the 37 bytes that follow can hold; the "
            "file is cut short or its count is wrong");
}

const std::string kPly =
    "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty uchar red\nproperty float "
    "z\nproperty double x\nproperty list uchar int extras\nproperty float y\nelement edge 1\nproperty int "
    "a\nproperty int b\nelement face 1\nproperty uchar flags\nproperty list uint8 int32 "
    "vertex_index\nproperty list uchar float texcoord\nend_header\n255 0 0 0 0\n255 0 1 2 7 8 0\n255 0 1 0 "
    "1\n255 0 0 1 9 1\n0 1\n1 4 0 1 2 3 2 0.5 0.5\n";

TEST(Ply, PropertiesInAnyOrderOtherListsAndElements) {
  const TriMesh mesh = triangles_in("a.ply", kPly);
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh.X.row(1), Eigen::RowVector3d(1, 0, 0));
  EXPECT_EQ(mesh.X.row(3), Eigen::RowVector3d(0, 1, 0));
}

template <typename T>
void append(std::string& bytes, T value, bool big) {
  std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
  if (big) raw.assign(raw.rbegin(), raw.rend());
  bytes += raw;
}

std::string binary_ply(bool big, const std::string& line_end = "\n") {
  std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                      "_endian 1.0\nelement vertex 3\nproperty short x\nproperty double y\nproperty list "
                      "ushort char l\nproperty float z\nelement face 1\nproperty list int ushort "
                      "vertex_indices\nproperty uint id\nend_header\n";
  for (std::size_t at = 0; (at = bytes.find('\n', at)) != std::string::npos; at += line_end.size())
    bytes.replace(at, 1, line_end);
  const double X[3][3] = {{-5, 0.25, 0.5}, {300, 0, 0}, {0, 1e-200, 1}};
  for (const double* x : {X[0], X[1], X[2]}) {
    append(bytes, static_cast<std::int16_t>(x[0]), big);
    append(bytes, x[1], big);
    append(bytes, std::uint16_t{2}, big);
    bytes += "ab";
    append(bytes, static_cast<float>(x[2]), big);
  }
  append(bytes, std::int32_t{3}, big);
  for (const std::uint16_t corner : {2, 0, 1}) append(bytes, corner, big);
  append(bytes, std::uint32_t{77}, big);
  return bytes;
}

TEST(Ply, BinaryOfBothByteOrders) {
  for (const bool big : {false, true}) {
    for (const char* line_end : {"\n", "\r\n"}) {
      const TriMesh mesh = triangles_in("a.ply", binary_ply(big, line_end));
      EXPECT_EQ(mesh.triangles, (Triangles{{2, 0, 1}}));
      Points X(3, 3);
      X << -5, 0.25, 0.5, 300, 0, 0, 0, 1e-200, 1;
      EXPECT_EQ(mesh.X, X);
    }
  }
}

TEST(Ply, WhatIsWrongIsToldWithItsPlace) {
  const auto error = [](std::string_view from, std::string_view to) {
    return tri_error("a.ply", replaced(kPly, from, to));
  };
  EXPECT_EQ(error("format ascii", "format text"),
            "a.ply:2: the format is 'text'; ascii, binary_little_endian and binary_big_endian are known");
  EXPECT_EQ(
      error("property float z", "property half z"),
      "a.ply:6: property type 'half'; char, uchar, short, ushort, int, uint, float and double are known");
  EXPECT_EQ(error("property float z", "property float w"), "a.ply:17: element 'vertex' has no property 'z'");
  EXPECT_EQ(error("list uint8 int32", "list float int32"),
            "a.ply:15: the length of a list is no integer; it must be one");
  EXPECT_EQ(error("list uint8 int32", "list uint8 float"),
            "a.ply:17: element 'face' has no list 'vertex_indices' of integers");
  EXPECT_EQ(error("element face", "element tristrips"),
            "a.ply:17: no element 'face'; a surface is needed, not points");
  EXPECT_EQ(error("element vertex 4", "element vertex 1000000000"),
            "a.ply:17: the number of elements 'vertex' is 1000000000, more than the 80 bytes that follow can "
            "hold; the file is cut short or its count is wrong");
  EXPECT_EQ(error("1 4 0 1 2 3 2", "1 4 0 1 2 4 2"), "a.ply:23: a face's vertex is 4; it must be in 0..3");
  EXPECT_EQ(error("0.5 0.5\n", "0.5 0.5 9\n"),
            "a.ply:23: 2 bytes follow the last element; are the counts of the header right?");
  EXPECT_EQ(error("0.5 0.5\n", "0.5\n"), "a.ply:24: the file ends where a property should be");
  EXPECT_EQ(tri_error("a.ply", binary_ply(true).substr(0, 262)),
            "a.ply: byte 261: the file ends within a property: 2 bytes are needed, 1 are left");
  EXPECT_EQ(tri_error("a.ply", binary_ply(true) + "x"),
            "a.ply: byte 281: 1 bytes follow the last element; are the counts of the header right?");
}

const std::string kStl =
    "solid a name\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 "
    "0\nendloop\nendfacet\n  FACET NORMAL nan nan nan\n OUTER LOOP\n VERTEX 0 0 0\n VERTEX 1 1 0\n VERTEX 0 "
    "1.5e0 0\n ENDLOOP\n ENDFACET\nendsolid a name\nsolid\nendsolid\n";

std::string binary_stl(std::string header) {
  header.resize(80, ' ');
  append(header, std::uint32_t{1}, false);
  for (const float x : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 0.1f, 0.f})
    append(header, x, false);
  return header + "xy";
}

TEST(Stl, AsciiOfSeveralSolidsInEitherCase) {
  const TriMesh mesh = triangles_in("a.stl", kStl);
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh.X.row(3), Eigen::RowVector3d(0, 1.5, 0));
}

TEST(Stl, BinaryEvenWhenItBeginsWithSolid) {
  for (const char* header : {"a binary file", "solid work by a careless program", "solid\n"}) {
    const TriMesh mesh = triangles_in("a.stl", binary_stl(header));
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
    EXPECT_EQ(mesh.X(2, 1), static_cast<double>(0.1f));
  }
}

TEST(Stl, WhatIsWrongIsToldWithItsPlace) {
  const auto error = [](std::string_view from, std::string_view to) {
    return tri_error("a.stl", replaced(kStl, from, to));
  };
  EXPECT_EQ(error("vertex 1 0 0", "vertex 1 0"),
            "a.stl:6: expected a vertex coordinate (a number), found 'vertex'");
  EXPECT_EQ(error("vertex 1 0 0\n", ""), "a.stl:6: expected 'vertex', found 'endloop'");
  EXPECT_EQ(error("vertex 1 0 0", "vertex 1 inf 0"),
            "a.stl:5: 'inf' is not finite; a vertex coordinate must be");
  EXPECT_EQ(error("solid\nendsolid\n", "solid\n"), "a.stl:18: the file ends where endsolid should be");
  EXPECT_EQ(tri_error("a.stl", "hello\n"), "a.stl:1: expected 'solid', found 'hello'");
  EXPECT_EQ(tri_error("a.stl", binary_stl("solid").substr(0, 100)),
            "a.stl: byte 80: the number of triangles is 1, which takes 50 bytes; 16 follow");
  std::string nan = binary_stl("");
  nan.replace(96, 4, std::string("\0\0\xc0\x7f", 4));
  EXPECT_EQ(tri_error("a.stl", nan), "a.stl: byte 96: a vertex coordinate is nan; it must be finite");
}

}  // namespace surface_formats_test
}  // namespace lagomorph::sim
