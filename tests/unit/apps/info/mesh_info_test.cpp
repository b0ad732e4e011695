#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "apps/info/info.h"
#include "sim/error.h"
#include "sim/mesh_io.h"
#include "tests/support/temporary_directory.h"

namespace lagomorph::apps {
namespace mesh_info_test {

/// Two tets on the unit right triangle, of tags 3 and 7, apexes 1 above and 2 below; and a vertex of neither.
const char stray_medit[] =
    "MeshVersionFormatted 2\nDimension 3\nVertices\n6\n0 0 0 0\n1 0 0 0\n5 5 5 0\n0 1 0 0\n0 0 1 0\n0 0 -2 "
    "0\n"
    "Tetrahedra\n2\n1 2 4 5 3\n1 4 2 6 7\nEnd\n";

TEST(MeshInfo, MendsAndTellsATetMesh) {
  const tests::TemporaryDirectory directory;
  const auto stray = directory.write("stray.mesh", stray_medit);
  EXPECT_THROW(tet_mesh_info(stray), sim::InputError);

  const auto mended = directory.path() / "mended.msh";
  const Report mending = mend_tet_mesh(stray, mended);
  EXPECT_EQ(nlohmann::json::parse(mending.json())["dropped"], 1);
  EXPECT_NE(mending.text().find("1 stray vertex of " + stray.string() + " dropped"), std::string::npos)
      << mending.text();

  const Report report = tet_mesh_info(mended);
  const nlohmann::json json = nlohmann::json::parse(report.json());
  EXPECT_EQ(json["kind"], "tet mesh");
  EXPECT_EQ(json["file"], mended.string());
  EXPECT_EQ(json["vertices"], 5);
  EXPECT_EQ(json["tets"], 2);
  EXPECT_EQ(json["boundary"]["triangles"], 6);
  EXPECT_EQ(json["boundary"]["closed"], true);
  EXPECT_EQ(json["bounding_box"]["min"], nlohmann::json({0.0, 0.0, -2.0}));
  EXPECT_EQ(json["bounding_box"]["max"], nlohmann::json({1.0, 1.0, 1.0}));
  EXPECT_EQ(json["size"], nlohmann::json({1.0, 1.0, 3.0}));
  EXPECT_NEAR(json["volume"].get<double>(), 0.5, 1e-15);
  EXPECT_NEAR(json["volume_ratio"].get<double>(), 0.5, 1e-15);
  EXPECT_NEAR(json["dihedral_degrees"]["max"].get<double>(), 90.0, 1e-12);
  // Smallest: the upper tet's, between x + y + z = 1 and a coordinate plane, whose cosine is 1/sqrt(3); of
  // the lower, x + y - z/2 = 1, against x = 0: cosine 2/3.
  EXPECT_NEAR(json["dihedral_degrees"]["min"].get<double>(), std::acos(2.0 / 3.0) * 180.0 / std::numbers::pi,
              1e-12);
  EXPECT_EQ(json["tags"], nlohmann::json({{"3", 1}, {"7", 1}}));
  for (const char* line : {
           "mended.msh: tetrahedral mesh\n",
           "\n  vertices         5\n",
           "\n  boundary         6 triangles, closed\n",
           "\n  bounding box     [0, 0, -2] to [1, 1, 1] m\n",
           "\n  size             1 x 1 x 3 m\n",
           "\n  volume           0.5 m^3\n",
           "\n  dihedral angles  48.19 to 90 degrees\n",
           "\n  tags             3 (1 tets), 7 (1 tets)\n",
       }) {
    EXPECT_NE(report.text().find(line), std::string::npos) << line << "\nin\n" << report.text();
  }
}

TEST(MeshInfo, MendsInPlaceAndWhatNeedsNone) {
  const tests::TemporaryDirectory directory;
  const auto file = directory.write("stray.mesh", stray_medit);
  mend_tet_mesh(file, file);
  EXPECT_EQ(nlohmann::json::parse(tet_mesh_info(file).json())["vertices"], 5);
  EXPECT_EQ(nlohmann::json::parse(mend_tet_mesh(file, file).json())["dropped"], 0);
  EXPECT_THROW(mend_tet_mesh(file, directory.path() / "a.stp"), sim::InputError);
}

TEST(MeshInfo, TellsASurface) {
  const tests::TemporaryDirectory directory;
  const auto closed = directory.write("closed.obj",
                                      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                      "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const nlohmann::json json = nlohmann::json::parse(tri_mesh_info(closed).json());
  EXPECT_EQ(json["kind"], "surface");
  EXPECT_EQ(json["vertices"], 4);
  EXPECT_EQ(json["triangles"], 4);
  EXPECT_EQ(json["surface"]["closed"], true);
  EXPECT_EQ(json["size"], nlohmann::json({1.0, 1.0, 1.0}));

  const auto open = directory.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Report report = tri_mesh_info(open);
  EXPECT_NE(report.text().find("\n  surface       not closed, 3 open edges\n"), std::string::npos)
      << report.text();
  EXPECT_EQ(nlohmann::json::parse(report.json())["surface"]["open_edges"], 3);
  EXPECT_FALSE(nlohmann::json::parse(report.json())["remarks"].empty());
}

TEST(Report, Counts) {
  EXPECT_EQ(count_text(0), "0");
  EXPECT_EQ(count_text(999), "999");
  EXPECT_EQ(count_text(1000), "1,000");
  EXPECT_EQ(count_text(1234567), "1,234,567");
}

TEST(Report, IsOneLineAFactAndJsonWhateverTheBytes) {
  Report report("a\nb: thing", "thing", "a\xFF");
  report.add("name", "two\nlines", "name", "two\nlines");
  EXPECT_EQ(report.text(), "a\\nb: thing\n  name  two\\nlines\n");
  EXPECT_EQ(nlohmann::json::parse(report.json())["name"], "two\nlines");
}

}  // namespace mesh_info_test
}  // namespace lagomorph::apps
