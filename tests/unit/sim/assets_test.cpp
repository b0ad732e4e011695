// The committed meshes are what assets/README.md says.

#include <cmath>
#include <filesystem>
#include <string>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "sim/mesh_check.h"
#include "sim/mesh_io.h"
#include "sim/surface.h"
#include "tests/support/paths.h"

namespace lagomorph::sim {
namespace assets_test {

std::filesystem::path asset(const std::string& name) {
  return lagomorph::tests::source_dir() / "assets" / "meshes" / name;
}

TEST(Assets, TheBunnySurfaceIsClosedOutwardAndOneMetreTall) {
  Remarks remarks;
  const TriMesh bunny = read_tri_mesh(asset("bunny.obj"), remarks);
  EXPECT_EQ(remarks, Remarks{});  // closed, consistently oriented, no vertices welded
  EXPECT_EQ(bunny.X.rows(), 7350);
  EXPECT_EQ(bunny.triangles.size(), 14696u);
  const Vec3 low = bunny.X.colwise().minCoeff(), high = bunny.X.colwise().maxCoeff();
  EXPECT_EQ(low.y(), 0.0);
  EXPECT_EQ(high.y(), 1.0);
  EXPECT_NEAR(low.x() + high.x(), 0.0, 2e-6);
  EXPECT_NEAR(low.z() + high.z(), 0.0, 2e-6);
  double volume = 0.0;
  for (const Triangle& t : bunny.triangles) {
    const Mat3 corners = (Mat3() << bunny.X.row(t[0]), bunny.X.row(t[1]), bunny.X.row(t[2])).finished();
    volume += corners.determinant() / 6.0;
  }
  EXPECT_NEAR(volume, 0.218703, 1e-6);  // positive: outward
}

struct TetBunny {
  const char* file;
  int vertices, tets;
  double min_dihedral, max_dihedral, volume_ratio;  // to the digits of the README
};

class AssetsTetBunny : public testing::TestWithParam<TetBunny> {};

TEST_P(AssetsTetBunny, HoldsTheSurfaceInGoodTets) {
  const TetBunny& expected = GetParam();
  Remarks remarks;
  const TetMesh mesh = read_tet_mesh(asset(expected.file), remarks);
  const TriMesh fine = read_tri_mesh(asset("bunny.obj"), remarks);
  EXPECT_EQ(remarks, Remarks{});
  EXPECT_EQ(mesh.vertex_count(), expected.vertices);
  EXPECT_EQ(mesh.tet_count(), expected.tets);
  const TetMeshQuality figures = quality(mesh);
  EXPECT_TRUE(figures.closed);
  EXPECT_NEAR(figures.min_dihedral_degrees, expected.min_dihedral, 0.05);
  EXPECT_NEAR(figures.max_dihedral_degrees, expected.max_dihedral, 0.05);
  EXPECT_NEAR(figures.volume_ratio, expected.volume_ratio, 0.01 * expected.volume_ratio);

  // Around the surface, and close to it.
  const Surface surface = Surface::embedded(mesh, 0, fine);
  EXPECT_EQ(surface.outside_count(), 0);
  EXPECT_EQ(surface.outside_distance(), 0.0);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(figures.min[k], fine.X.col(k).minCoeff(), 0.01);
    EXPECT_NEAR(figures.max[k], fine.X.col(k).maxCoeff(), 0.01);
  }
  const Points moved = surface.positions(as_q(mesh.X));
  EXPECT_LT((moved - fine.X).cwiseAbs().maxCoeff(), 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Meshes, AssetsTetBunny,
                         testing::Values(TetBunny{"bunny_5k.msh", 1334, 4932, 18.0, 151.0, 9.02e-4},
                                         TetBunny{"bunny_25k.msh", 5499, 25666, 16.9, 154.5, 1.86e-3}),
                         [](const auto& info) {
                           return "bunny_" + std::to_string(info.param.tets) + "_tets";
                         });

TEST(Assets, TheBarIsTheReferenceSolutions) {
  Remarks remarks;
  const TetMesh bar = read_tet_mesh(asset("bar.msh"), remarks);
  const TetMesh truth =
      read_tet_mesh(lagomorph::tests::source_dir() / "tests" / "data" / "truth" / "bar.msh", remarks);
  EXPECT_EQ(bar.X, truth.X);
  EXPECT_EQ(bar.tets, truth.tets);
  EXPECT_EQ(bar.tags, truth.tags);
}

}  // namespace assets_test
}  // namespace lagomorph::sim
