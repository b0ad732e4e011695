#include "sim/mesh_io.h"

#include <gtest/gtest.h>

#include "sim/mesh_check.h"
#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace {

TEST(MeshIo, ReadsTheTruthBarTheSameFromMeditAndGmsh) {
  Remarks remarks;
  const TetMesh medit = read_tet_mesh(data_path("truth/bar.mesh"), remarks);
  const TetMesh gmsh = read_tet_mesh(data_path("truth/bar.msh"), remarks);
  EXPECT_EQ(remarks, Remarks{});
  EXPECT_EQ(medit.vertex_count(), 399);
  EXPECT_EQ(medit.tet_count(), 1243);
  EXPECT_EQ(medit.X, gmsh.X);
  EXPECT_EQ(medit.tets, gmsh.tets);
  EXPECT_EQ(medit.tags, gmsh.tags);
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

}  // namespace
}  // namespace lagomorph::sim
