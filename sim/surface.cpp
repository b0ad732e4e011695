#include "sim/surface.h"

#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "sim/error.h"
#include "sim/mesh_topology.h"
#include "sim/point_location.h"
#include "sim/text.h"

namespace lagomorph::sim {
namespace {

const Body& body_of(const TetMesh& mesh, int body) {
  if (body < 0 || body >= static_cast<int>(mesh.bodies.size())) {
    throw InputError("body " + std::to_string(body) + " of a mesh with " +
                     std::to_string(mesh.bodies.size()) + " bodies");
  }
  return mesh.bodies[static_cast<std::size_t>(body)];
}

}  // namespace

Surface Surface::boundary(const TetMesh& mesh, int body) {
  Surface surface;
  surface.triangles_ = drawn_boundary(mesh, body_of(mesh, body).tets);
  // Surface vertices are numbered in the order of the mesh's.
  std::vector<int> number(static_cast<std::size_t>(mesh.vertex_count()), -1);
  for (const Triangle& triangle : surface.triangles_) {
    for (const int corner : triangle) number[static_cast<std::size_t>(corner)] = 0;
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<int>(entries.size());
    entries.emplace_back(number[v], static_cast<int>(v), 1.0);
  }
  for (Triangle& triangle : surface.triangles_) {
    for (int& corner : triangle) corner = number[static_cast<std::size_t>(corner)];
  }
  surface.W_.resize(static_cast<Eigen::Index>(entries.size()), mesh.vertex_count());
  surface.W_.setFromTriplets(entries.begin(), entries.end());
  return surface;
}

Surface Surface::embedded(const TetMesh& mesh, int body, const TriMesh& fine, double max_outside) {
  const Body& carrier = body_of(mesh, body);
  const PointLocation where(mesh, carrier.tets);
  const auto count = static_cast<std::size_t>(fine.X.rows());
  std::vector<Location> locations(count);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 256),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        locations[i] = where.locate(fine.X.row(static_cast<Eigen::Index>(i)).transpose());
                      }
                    });

  Surface surface;
  surface.triangles_ = fine.triangles;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(4 * count);
  std::size_t furthest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Location& location = locations[i];
    if (location.distance > 0.0) ++surface.outside_count_;
    if (location.distance > locations[furthest].distance) furthest = i;
    for_each_phi(mesh, location.tet, location.phi,
                 [&](int node, double phi) { entries.emplace_back(static_cast<int>(i), node, phi); });
  }
  surface.outside_ = count == 0 ? 0.0 : locations[furthest].distance;

  const auto vertices = mesh.X.middleRows(carrier.vertices.begin, carrier.vertices.size());
  const double diagonal = (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm();
  if (surface.outside_ > max_outside * diagonal) {
    const auto X = fine.X.row(static_cast<Eigen::Index>(furthest));
    throw InputError("vertex " + std::to_string(furthest) + " (numbered from 0) of the fine surface at [" +
                     short_number(X[0]) + ", " + short_number(X[1]) + ", " + short_number(X[2]) + "] is " +
                     short_number(surface.outside_) + " m outside of the tets of body '" + carrier.name +
                     "'; at most " + short_number(max_outside * diagonal) + " m, " +
                     short_number(100.0 * max_outside) + " % of its size, can be carried");
  }
  surface.W_.resize(static_cast<Eigen::Index>(count), mesh.vertex_count());
  surface.W_.setFromTriplets(entries.begin(), entries.end());
  return surface;
}

Points Surface::positions(const VecX& q) const {
  const auto x = as_points(q);
  if (x.rows() != W_.cols()) {
    throw InputError("positions of " + std::to_string(x.rows()) + " vertices for a mesh of " +
                     std::to_string(W_.cols()));
  }
  Points result(W_.rows(), 3);
  // Each row is a sum of its own in a fixed order: the same for any number of threads.
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, W_.rows(), 4096),
                    [&](const tbb::blocked_range<Eigen::Index>& range) {
                      for (Eigen::Index row = range.begin(); row < range.end(); ++row) {
                        Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
                        for (Weights::InnerIterator entry(W_, row); entry; ++entry)
                          sum += entry.value() * x.row(entry.col());
                        result.row(row) = sum;
                      }
                    });
  return result;
}

}  // namespace lagomorph::sim
