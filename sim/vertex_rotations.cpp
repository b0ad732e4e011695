#include "sim/vertex_rotations.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "sim/parallel.h"

namespace lagomorph::sim {

namespace {

constexpr int kPolarVertices = 512;  // of a piece of work
constexpr int kMostPolarSteps = 20;

}  // namespace

Mat3 nearest_rotation(const Mat3& F) {
  const double J = F.determinant();
  if (!(J > 0.0)) return Mat3::Identity();
  Mat3 R = F / std::cbrt(J);
  for (int step = 0; step < kMostPolarSteps; ++step) {
    Mat3 cofactors;
    cofactors << R.col(1).cross(R.col(2)), R.col(2).cross(R.col(0)), R.col(0).cross(R.col(1));
    const double determinant = R.col(0).dot(cofactors.col(0));
    if (!(determinant > 0.0)) break;
    const Mat3 next = 0.5 * (R + cofactors / determinant);
    const double change = (next - R).squaredNorm();
    R = next;
    if (change < 1e-12) return R;
  }
  return Mat3::Identity();
}

VertexRotations vertex_rotations(const TetMesh& mesh, const VecX& q) {
  VertexRotations found;
  std::vector<Mat3>& turned = found.R;
  turned.assign(static_cast<std::size_t>(mesh.vertex_count()), Mat3::Zero());
  std::vector<double> volumes(turned.size(), 0.0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Tet& tet = mesh.tets[t];
    const auto rest = [&](int k) -> Vec3 { return mesh.X.row(tet[static_cast<std::size_t>(k)]).transpose(); };
    const auto now = [&](int k) -> Vec3 { return q.segment<3>(3 * tet[static_cast<std::size_t>(k)]); };
    const Vec3 a = rest(1) - rest(0), b = rest(2) - rest(0), c = rest(3) - rest(0);
    Mat3 edges, gradients;
    edges << now(1) - now(0), now(2) - now(0), now(3) - now(0);
    gradients << b.cross(c), c.cross(a), a.cross(b);  // six times the volume times Dm⁻ᵀ
    const Mat3 F = edges * gradients.transpose();
    const auto add = [&](int vertex) {
      turned[static_cast<std::size_t>(vertex)] += F;
      volumes[static_cast<std::size_t>(vertex)] += a.dot(b.cross(c));
    };
    for (const int vertex : tet) add(vertex);
    if (!mesh.is_quadratic(t)) continue;
    for (const int vertex : mesh.midsides[t]) add(vertex);
  }
  parallel_for(mesh.vertex_count(), kPolarVertices, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      Mat3& R = turned[static_cast<std::size_t>(i)];
      double& volume = volumes[static_cast<std::size_t>(i)];
      const Mat3 F = R / std::max(volume, 1e-300);
      R = nearest_rotation(F);
      volume = (F - R).squaredNorm();
    }
  });
  double sum = 0.0;
  for (const double square : volumes) sum += square;
  found.strain = std::sqrt(sum / std::max(1.0, static_cast<double>(volumes.size())));
  return found;
}

}  // namespace lagomorph::sim
