#include <bit>
#include <cstdint>
#include <type_traits>

#include <gtest/gtest.h>

#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace gmsh_test {

const std::string kNodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
const std::string kTet22 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + kNodes +
                           "$Elements\n2\n1 15 2 0 1 1\n2 4 2 9 1 1 2 3 4\n$EndElements\n";
const std::string kTet41 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n1 0 0 0 1 1 1 1 9 0\n$EndEntities\n$Nodes\n1 "
    "4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 "
    "4\n$EndElements\n";

TEST(Gmsh, SparseNodeTagsMixedElementsAndOtherSectionsAreRead) {
  const TetMesh mesh =
      tets_in("a.msh",
              "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\nanything $at "
              "all\n$EndComments\n$PhysicalNames\n1\n3 9 \"a b\"\n$EndPhysicalNames\n$Nodes\n5\n900000000000 "
              "0 0 0\n-3 1 0 0\n17 0 1 0\n4 0 0 1\n5 1 1 1\n$EndNodes\n$Elements\n6\n1 15 2 0 1 4\n2 1 3 0 1 "
              "99 4 5\n3 2 0 4 5 17\n10 4 2 9 1 900000000000 -3 17 4\n5 3 2 0 1 4 5 17 -3\n6 4 4 8 1 1 0 -3 "
              "17 4 5\n$EndElements\n$NodeData\n1\n\"a view\"\n$EndNodeData\n");
  EXPECT_EQ(mesh.vertex_count(), 5);
  EXPECT_EQ(mesh.tets, (std::vector<Tet>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(mesh.tags, (std::vector<int>{9, 8}));
}

TEST(Gmsh, SparseNodeTagsOfFourPointOne) {
  const TetMesh mesh =
      tets_in("a.msh",
              "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 1 1 2\n7 0 0 0 1 5\n8 0 0 0 1 1 1 0 2 7 "
              "-7\n9 0 0 0 1 1 1 2 1 2 1 8\n1 0 0 0 1 1 1 2 -3 4 1 9\n2 0 0 0 1 1 1 0 "
              "0\n$EndEntities\n$Nodes\n3 5 10 5000000000\n2 9 1 2\n5000000000\n10\n0 0 0 0.5 0.5\n1 0 0 0.5 "
              "0.25\n0 7 0 0\n3 1 0 3\n12\n13\n14\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n$Elements\n3 3 1 3\n2 9 2 "
              "1\n1 10 12 13\n3 1 4 1\n2 5000000000 10 12 13\n3 2 4 1\n3 10 12 13 14\n$EndElements\n");
  EXPECT_EQ(mesh.tets, (std::vector<Tet>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(mesh.tags, (std::vector<int>{3, 0}));
}

/// Binary files are put together here, so that both byte orders can be had.
class Bytes {
public:
  explicit Bytes(bool big) : big_(big) {}
  Bytes& text(std::string_view text) { return bytes_ += text, *this; }
  template <typename T>
  Bytes& values(std::initializer_list<T> values) {
    for (const T value : values) {
      std::string raw(reinterpret_cast<const char*>(&value), sizeof(T));
      if (big_) raw.assign(raw.rbegin(), raw.rend());
      bytes_ += raw;
    }
    return *this;
  }
  Bytes& ints(std::initializer_list<std::int32_t> v) { return values(v); }
  Bytes& sizes(std::initializer_list<std::uint64_t> v) { return values(v); }
  Bytes& doubles(std::initializer_list<double> v) { return values(v); }
  const std::string& get() const { return bytes_; }

private:
  bool big_;
  std::string bytes_;
};

std::string binary_22(bool big, double last = 1.0, std::int32_t follow = 1) {
  Bytes bytes(big);
  bytes.text("$MeshFormat\n2.2 1 8\n").ints({1}).text("\n$EndMeshFormat\n$Nodes\n4\n");
  bytes.ints({1})
      .doubles({0, 0, 0})
      .ints({2})
      .doubles({1, 0, 0})
      .ints({3})
      .doubles({0, 1, 0})
      .ints({40})
      .doubles({0, 0, last});
  bytes.text("\n$EndNodes\n$Elements\n4\n");
  bytes.ints({15, 2, 2, 1, 0, 1, 1, 2, 0, 1, 2});  // two points in a block
  bytes.ints({2, 1, 0, 3, 1, 2, 3});               // a triangle without tags
  bytes.ints({4, follow, 3, 9, 5, 1, 0, 1, 2, 3, 40});
  return bytes.text("\n$EndElements\n").get();
}

std::string binary_41(bool big, std::uint64_t nodes = 4) {
  Bytes bytes(big);
  bytes.text("$MeshFormat\n4.1 1 8\n").ints({1}).text("\n$EndMeshFormat\n$Entities\n").sizes({1, 0, 0, 1});
  bytes.ints({1}).doubles({0, 0, 0}).sizes({0});
  bytes.ints({1}).doubles({0, 0, 0, 1, 1, 1}).sizes({1}).ints({5}).sizes({2}).ints({1, -2});
  bytes.text("\n$EndEntities\n$Nodes\n").sizes({1, nodes, 1, 40}).ints({3, 1, 0}).sizes({nodes, 1, 2, 3, 40});
  bytes.doubles({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  bytes.text("\n$EndNodes\n$Elements\n").sizes({2, 2, 1, 2});
  bytes.ints({0, 1, 15}).sizes({1, 1, 1}).ints({3, 1, 4}).sizes({1, 2, 1, 2, 3, 40});
  return bytes.text("\n$EndElements\n").get();
}

TEST(Gmsh, BinaryFilesOfBothByteOrdersAreRead) {
  for (const bool big : {false, true}) {
    for (const std::string& bytes : {binary_22(big), binary_41(big)}) {
      const TetMesh mesh = tets_in("a.msh", bytes);
      EXPECT_EQ(mesh.X, one_tet().X);
      EXPECT_EQ(mesh.tets, one_tet().tets);
      EXPECT_EQ(mesh.tags, std::vector<int>{5});
    }
  }
}

TEST(Gmsh, ErrorsInBinaryFilesTellTheByte) {
  const std::string bytes = binary_22(false, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(tet_error("a.msh", bytes), "a.msh: byte 153: a node's coordinate is nan; it must be finite");
  EXPECT_EQ(tet_error("a.msh", binary_22(false, 1.0, 7)),
            "a.msh: byte 260: the number of elements that follow is 7; 1 are left");
  EXPECT_EQ(tet_error("a.msh", binary_22(true).substr(0, 100)),
            "a.msh: byte 47: the number of nodes is 4, more than the 52 bytes that follow can hold; the file "
            "is cut short or its count is wrong");
  EXPECT_EQ(tet_error("a.msh", binary_41(false, 1'000'000'000'000)),
            "a.msh: byte 227: the number of nodes is 1000000000000, more than the 327 bytes that follow can "
            "hold; the file is cut short or its count is wrong");
  EXPECT_EQ(tet_error("a.msh", replaced(binary_22(false), "2.2 1 8\n\1", "2.2 1 8\n\2")),
            "a.msh: byte 20: the integer that tells the byte order is 2; it must be 1");
}

TEST(Gmsh, WhatIsWrongIsToldWithItsLine) {
  const auto error = [](std::string_view from, std::string_view to) {
    return tet_error("a.msh", replaced(kTet22, from, to));
  };
  EXPECT_EQ(tets_in("a.msh", kTet22).tags, std::vector<int>{9});
  EXPECT_EQ(
      error("2.2 0 8", "1.0 0 8"),
      "a.msh:2: format version '1.0'; 2.2 and 4.1 can be read (gmsh OLD.msh -save -format msh41 -o NEW.msh)");
  EXPECT_EQ(error("2.2 0 8", "2.2 0 4"), "a.msh:2: the data size is 4; it must be 8");
  EXPECT_EQ(error("2.2 0 8", "2.2 3 8"), "a.msh:2: the file type is 3; it must be 0 (ASCII) or 1 (binary)");
  EXPECT_EQ(error("3 0 1 0\n", "2 0 1 0\n"), "a.msh:9: node tag 2 is there twice");
  EXPECT_EQ(error("1 2 3 4\n", "1 2 3 7\n"),
            "a.msh:14: a tetrahedron's node is 7; there is no such node in $Nodes");
  EXPECT_EQ(error("$Nodes\n4", "$Nodes\n3"),
            "a.msh:9: expected '$EndNodes', found '4'; is the count in $Nodes right?");
  EXPECT_EQ(error("$Nodes\n4", "$Nodes\n5"),
            "a.msh:10: expected a node's number (an integer), found '$EndNodes'");
  EXPECT_EQ(error("$Nodes\n4", "$Nodes\n1000000000000"),
            "a.msh:5: the number of nodes is 1000000000000, more than the 99 bytes that follow can hold; the "
            "file is cut short or its count is wrong");
  EXPECT_EQ(error("2 4 2 9", "2 4 -2 9"),
            "a.msh:14: the number of an element's tags is -2; it cannot be negative");
  EXPECT_EQ(error("$EndElements\n", ""), "a.msh:15: the file ends where $EndElements should be");
  EXPECT_EQ(error("$Elements", "$Elephants"), "a.msh:11: $Elephants has no $EndElephants");
  EXPECT_EQ(error(kNodes, ""), "a.msh:4: $Elements before $Nodes");
  EXPECT_EQ(error("$MeshFormat", "$NOD"), "a.msh:1: expected '$MeshFormat', found '$NOD'");
  EXPECT_EQ(tet_error("a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"), "a.msh:3: no section $Nodes");
  EXPECT_EQ(tet_error("a.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\nNodes\n"),
            "a.msh:4: expected a section such as $Nodes, found 'Nodes'");
}

TEST(Gmsh, CountsOfBlocksMustAgree) {
  const auto error = [](std::string_view from, std::string_view to) {
    return tet_error("a.msh", replaced(kTet41, from, to));
  };
  EXPECT_EQ(tets_in("a.msh", kTet41).tags, std::vector<int>{9});
  EXPECT_EQ(error("1 4 1 4", "1 5 1 4"), "a.msh:18: $Nodes says 5 nodes, its blocks have 4");
  EXPECT_EQ(error("1 4 1 4", "1 3 1 4"), "a.msh:10: a block of 4 nodes where 3 are left");
  EXPECT_EQ(error("1 1 1 1\n3 1 4 1", "1 2 1 1\n3 1 4 1"),
            "a.msh:23: $Elements says 2 elements, its blocks have 1");
  EXPECT_EQ(error("1 1 1 1\n3 1 4 1", "1 0 1 1\n3 1 4 1"),
            "a.msh:22: a block of 1 elements where 0 are left");
  EXPECT_EQ(error("3 1 0 4", "5 1 0 4"), "a.msh:10: an entity's dimension is 5; it must be in 0..3");
}

TEST(Gmsh, OtherVolumesAreNamed) {
  EXPECT_EQ(
      tet_error("a.msh", replaced(kTet22, "2 4 2 9 1 1 2 3 4", "2 29 2 9 1 1 2 3 4")),
      "a.msh:14: element type 29, a 20-node tetrahedron; only 4-node and 10-node tetrahedra can be used for "
      "volumes");
  EXPECT_EQ(
      tet_error("a.msh", replaced(kTet41, "3 1 4 1\n", "3 1 5 1\n")),
      "a.msh:22: element type 5, a 8-node hexahedron; only 4-node and 10-node tetrahedra can be used for "
      "volumes");
  EXPECT_EQ(
      tet_error("a.msh", replaced(kTet22, "2 4 2 9", "2 1234 2 9")),
      "a.msh:14: element type 1234 is unknown; tetrahedra of 4 nodes (type 4) or 10 (type 11) are needed");
}

TEST(Gmsh, NodesOfOnlySurfaceElementsAreStray) {
  const std::string text =
      replaced(replaced(kTet22, "$Nodes\n4\n", "$Nodes\n5\n5 9 9 9\n"), "1 15 2 0 1 1", "1 15 2 0 1 5");
  EXPECT_NE(tet_error("a.msh", text)
                .find("1 stray vertex in no tet, numbered from 0: 0; drop them with: lagomorph info"),
            std::string::npos);
}

TEST(Gmsh, ATetThatIsThereOnceForEachOfItsGroupsIsToldAsOverlap) {
  const std::string text = replaced(kTet22, "2 4 2 9 1 1 2 3 4\n", "2 4 2 9 1 1 2 3 4\n3 4 2 8 1 1 2 3 4\n");
  EXPECT_NE(tet_error("a.msh", replaced(text, "$Elements\n2", "$Elements\n3")).find("tet 0 overlaps another"),
            std::string::npos);
}

}  // namespace gmsh_test
}  // namespace lagomorph::sim
