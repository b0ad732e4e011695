#include "sim/point_location.h"

#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace point_location_test {

TetCorners corners_of(const TetMesh& mesh, int j) {
  TetCorners corners;
  for (std::size_t k = 0; k < 4; ++k) {
    corners.col(static_cast<Eigen::Index>(k)) = mesh.X.row(mesh.tets[static_cast<std::size_t>(j)][k]);
  }
  return corners;
}

/// The oracle: projects onto every face, edge and corner of the tet and takes the nearest point that lies in
/// it.
double slow_distance(const TetCorners& corners, const Vec3& P) {
  if (phi(corners, P).minCoeff() >= 0.0) return 0.0;
  double best = std::numeric_limits<double>::infinity();
  for (int subset = 1; subset < 15; ++subset) {
    std::vector<int> chosen;
    for (int k = 0; k < 4; ++k) {
      if (subset & (1 << k)) chosen.push_back(k);
    }
    // Least squares for the weights of the simplex of chosen corners, of sum one.
    const Vec3 origin = corners.col(chosen[0]);
    Eigen::MatrixXd E(3, static_cast<Eigen::Index>(chosen.size()) - 1);
    for (std::size_t k = 1; k < chosen.size(); ++k)
      E.col(static_cast<Eigen::Index>(k) - 1) = corners.col(chosen[k]) - origin;
    const VecX w =
        E.cols() == 0 ? VecX() : VecX((E.transpose() * E).inverse() * (E.transpose() * (P - origin)));
    if (w.size() > 0 && (w.minCoeff() < 0.0 || w.sum() > 1.0)) continue;
    const Vec3 closest = w.size() > 0 ? Vec3(origin + E * w) : origin;
    best = std::min(best, (P - closest).norm());
  }
  return best;
}

TEST(PointLocation, DistanceToATetIsThatOfItsNearestFaceEdgeOrCorner) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    TetCorners corners = TetCorners::NullaryExpr([&] { return number(random); });
    if (tet_volume(corners) < 0.0) corners.col(0).swap(corners.col(1));
    if (tet_volume(corners) < 1e-3) continue;
    const Vec3 P = Vec3::NullaryExpr([&] { return 2.0 * number(random); });
    EXPECT_NEAR(distance_to_tet(corners, P, phi(corners, P)), slow_distance(corners, P), 1e-12);
  }
}

TEST(PointLocation, AgreesWithLookingAtEveryTet) {
  TetMesh mesh = cube_mesh(4);
  // Bend the grid so that nothing is aligned, and leave a dent, so that points outside have several tets
  // near.
  for (int i = 0; i < mesh.vertex_count(); ++i) {
    const Vec3 X = mesh.X.row(i);
    mesh.X.row(i) << X.x() + 0.2 * X.y() * X.y(), X.y() + 0.1 * X.z() * X.x(), X.z() - 0.3 * X.x() * X.x();
  }
  const PointLocation where(mesh, {0, mesh.tet_count()});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-0.4, 1.6);
  int outside = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 P = Vec3::NullaryExpr([&] { return number(random); });
    double nearest = std::numeric_limits<double>::infinity();
    for (int j = 0; j < mesh.tet_count(); ++j)
      nearest = std::min(nearest, slow_distance(corners_of(mesh, j), P));
    const Location location = where.locate(P);
    EXPECT_NEAR(location.distance, nearest, 1e-12);
    EXPECT_NEAR(slow_distance(corners_of(mesh, location.tet), P), nearest, 1e-12);
    EXPECT_NEAR(location.phi.sum(), 1.0, 1e-12);
    EXPECT_LT((interpolate(mesh, location, mesh.X) - P).norm(), 1e-12);
    outside += location.distance > 0.0;
  }
  EXPECT_GT(outside, 50);
  EXPECT_LT(outside, 450);
}

TEST(PointLocation, OnSharedFacesTheLowestTetIsTaken) {
  const TetMesh mesh = cube_mesh(3);
  const PointLocation where(mesh, {0, mesh.tet_count()});
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    int lowest = mesh.tet_count();
    for (int j = mesh.tet_count() - 1; j >= 0; --j) {
      const Tet& tet = mesh.tets[static_cast<std::size_t>(j)];
      if (std::find(tet.begin(), tet.end(), v) != tet.end()) lowest = j;
    }
    const Location location = where.locate(mesh.X.row(v));
    EXPECT_EQ(location.tet, lowest) << "vertex " << v;
    EXPECT_EQ(location.distance, 0.0);
  }
}

TEST(PointLocation, LooksOnlyAtItsRangeOfTets) {
  const TetMesh mesh = cube_mesh(2);
  const PointLocation where(mesh, {6, 12});  // the second cube
  const Location location = where.locate(Vec3(0.25, 0.2, 0.2));
  EXPECT_GE(location.tet, 6);
  EXPECT_LT(location.tet, 12);
  EXPECT_NEAR(location.distance, 0.25, 1e-15);
}

TEST(PointLocation, InterpolatesAnAffineMapExactly) {
  const TetMesh mesh = cube_mesh(3);
  const PointLocation where(mesh, {0, mesh.tet_count()});
  Mat3 A;
  A << 2.0, 0.5, 0.0, -0.25, 1.0, 0.75, 0.0, 0.125, 3.0;
  const Points x = mesh.X * A.transpose();
  for (const Vec3& P : {Vec3(0.1, 0.2, 0.3), Vec3(0.9, 0.1, 0.7), Vec3(1.5, 0.5, -0.5)}) {
    EXPECT_LT((interpolate(mesh, where.locate(P), x) - A * P).norm(), 1e-13);
  }
}

}  // namespace point_location_test
}  // namespace lagomorph::sim
