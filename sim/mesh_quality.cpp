#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "sim/mesh_check.h"
#include "sim/mesh_topology.h"
#include "sim/shape_functions.h"

namespace lagomorph::sim {
namespace {

/// Area vectors of the four faces, outward: half the cross product of two edges. [m^2]
std::array<Vec3, 4> face_areas(const TetCorners& X) {
  std::array<Vec3, 4> areas;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& face = kTetFaces[k];
    areas[k] = 0.5 * (X.col(face[1]) - X.col(face[0])).cross(X.col(face[2]) - X.col(face[0]));
  }
  return areas;
}

/// 3 r_in / r_circum: r_in = 3 vol / Σ area; the circumcentre c relative to X0 solves 2 T^T c = (|T_1|^2,
/// |T_2|^2, |T_3|^2).
double radius_ratio(const TetCorners& X, const std::array<Vec3, 4>& areas, double volume) {
  double area = 0.0;
  for (const Vec3& a : areas) area += a.norm();
  const Mat3 T = edge_matrix(X);
  const Vec3 center = T.transpose().inverse() * (0.5 * T.colwise().squaredNorm().transpose());
  return 3.0 * (3.0 * volume / area) / center.norm();
}

}  // namespace

TetMeshQuality quality(const TetMesh& mesh) {
  TetMeshQuality result;
  if (mesh.tets.empty() || mesh.X.rows() == 0) return result;
  result.min = mesh.X.colwise().minCoeff();
  result.max = mesh.X.colwise().maxCoeff();
  double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;
  // The extreme angles by their cosines: the larger the cosine, the smaller the angle.
  double largest_cosine = -1.0, smallest_cosine = 1.0;
  result.worst_radius_ratio = 1.0;
  for (const Tet& tet : mesh.tets) {
    TetCorners X;
    for (std::size_t k = 0; k < 4; ++k) X.col(static_cast<Eigen::Index>(k)) = mesh.X.row(tet[k]);
    const double volume = tet_volume(X);
    result.volume += volume;
    smallest = std::min(smallest, volume);
    largest = std::max(largest, volume);
    const std::array<Vec3, 4> areas = face_areas(X);
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        // Outward normals: the angle inside is the supplement of the one between them.
        const double cosine = -areas[a].normalized().dot(areas[b].normalized());
        largest_cosine = std::max(largest_cosine, cosine);
        smallest_cosine = std::min(smallest_cosine, cosine);
      }
    }
    result.worst_radius_ratio = std::min(result.worst_radius_ratio, radius_ratio(X, areas, volume));
  }
  const auto degrees = [](double cosine) {
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
  };
  result.min_dihedral_degrees = degrees(largest_cosine);
  result.max_dihedral_degrees = degrees(smallest_cosine);
  result.volume_ratio = smallest / largest;
  const std::vector<Triangle> boundary = boundary_triangles(mesh, {0, mesh.tet_count()});
  result.boundary_triangles = static_cast<int>(boundary.size());
  result.closed = surface_topology(boundary, mesh.vertex_count()).closed();
  return result;
}

}  // namespace lagomorph::sim
