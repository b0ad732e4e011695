#include <gtest/gtest.h>

#include "apps/commands.h"
#include "sim/error.h"
#include "sim/mesh_io.h"
#include "tests/support/temporary_directory.h"

namespace lagomorph::apps {
namespace refine_command_test {

const char two_tets[] =
    "MeshVersionFormatted 2\nDimension 3\nVertices\n5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 -2 0\n"
    "Tetrahedra\n2\n1 2 3 4 3\n1 3 2 5 7\nEnd\n";

sim::TetMesh refine(Options options, const tests::TemporaryDirectory& directory) {
  options.command = "refine";
  options.inputs = {directory.write("two.mesh", two_tets).string()};
  options.out = directory.path() / "out.msh";
  options.quiet = true;
  EXPECT_EQ(refine_command(options), ExitStatus::done);
  sim::Remarks remarks;
  return sim::read_tet_mesh(*options.out, remarks);
}

TEST(RefineCommand, SplitsTetsAndKeepsTags) {
  const tests::TemporaryDirectory directory;
  const sim::TetMesh once = refine({}, directory);
  EXPECT_EQ(once.tet_count(), 16);
  EXPECT_EQ(once.vertex_count(), 5 + 9);
  EXPECT_EQ(once.tags[7], 3);
  EXPECT_EQ(once.tags[8], 7);
  Options twice;
  twice.levels = 2;
  EXPECT_EQ(refine(twice, directory).tet_count(), 128);
}

TEST(RefineCommand, RaisesTheOrderAlone) {
  const tests::TemporaryDirectory directory;
  Options options;
  options.order = 2;
  const sim::TetMesh mesh = refine(options, directory);
  EXPECT_EQ(mesh.tet_count(), 2);
  EXPECT_EQ(mesh.vertex_count(), 5 + 9);
  EXPECT_EQ(mesh.midsides.size(), 2u);
  options.levels = 1;
  EXPECT_EQ(refine(options, directory).tet_count(), 16);
}

TEST(RefineCommand, NeedsAPlaceToWriteTo) {
  Options options;
  options.inputs = {"a.msh"};
  EXPECT_THROW(refine_command(options), Error);
  options.out = "a.stl";
  EXPECT_THROW(refine_command(options), sim::InputError);
}

}  // namespace refine_command_test
}  // namespace lagomorph::apps
