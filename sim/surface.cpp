#include "sim/surface.h"

#include <algorithm>
#include <set>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "sim/error.h"
#include "sim/mesh_topology.h"
#include "sim/point_location.h"
#include "sim/subdivision.h"
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

using Entries = std::vector<Eigen::Triplet<double>>;

/// Numbers the triangles' vertices from 0 on, in the order of the mesh's, with an entry of 1 for each.
Entries number_compactly(std::vector<Triangle>& triangles, int vertex_count) {
  std::vector<int> number(static_cast<std::size_t>(vertex_count), -1);
  for (const Triangle& triangle : triangles) {
    for (const int corner : triangle) number[static_cast<std::size_t>(corner)] = 0;
  }
  Entries entries;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<int>(entries.size());
    entries.emplace_back(number[v], static_cast<int>(v), 1.0);
  }
  for (Triangle& triangle : triangles) {
    for (int& corner : triangle) corner = number[static_cast<std::size_t>(corner)];
  }
  return entries;
}

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

}  // namespace

TetMesh kept_part(const TetMesh& mesh, int body, const Vec3& point, const Vec3& normal) {
  const Body& whole = body_of(mesh, body);
  TetMesh kept;
  kept.X = mesh.X;
  for (int t = whole.tets.begin; t < whole.tets.end; ++t) {
    const auto j = static_cast<std::size_t>(t);
    Vec3 centroid = Vec3::Zero();
    for (const int corner : mesh.tets[j]) centroid += 0.25 * mesh.X.row(corner).transpose();
    if ((centroid - point).dot(normal) < 0.0) continue;
    kept.tets.push_back(mesh.tets[j]);
    kept.tags.push_back(mesh.tags[j]);
    if (!mesh.midsides.empty()) kept.midsides.push_back(mesh.midsides[j]);
  }
  kept.bodies.push_back({whole.name, whole.vertices, {0, kept.tet_count()}});
  return kept;
}

Surface Surface::boundary(const TetMesh& mesh, int body) {
  Surface surface;
  surface.triangles_ = drawn_boundary(mesh, body_of(mesh, body).tets);
  const Entries entries = number_compactly(surface.triangles_, mesh.vertex_count());
  surface.first_cut_vertex_ = static_cast<int>(entries.size());
  surface.W_.resize(static_cast<Eigen::Index>(entries.size()), mesh.vertex_count());
  surface.W_.setFromTriplets(entries.begin(), entries.end());
  return surface;
}

Surface Surface::part(const TetMesh& whole, int body, const TetMesh& kept) {
  std::set<Triangle> skin;
  for (const BoundaryFace& face : boundary_faces(whole, body_of(whole, body).tets))
    skin.insert(sorted(face.corners));
  Surface surface;
  std::vector<Triangle> cut;
  for (const BoundaryFace& face : boundary_faces(kept, {0, kept.tet_count()}))
    add_drawn(face, skin.contains(sorted(face.corners)) ? surface.triangles_ : cut);
  Entries entries = number_compactly(surface.triangles_, whole.vertex_count());
  surface.first_cut_vertex_ = static_cast<int>(entries.size());
  for (Triangle triangle : cut) {
    for (int& corner : triangle) {
      const int own = static_cast<int>(entries.size());
      entries.emplace_back(own, corner, 1.0);
      corner = own;
    }
    surface.triangles_.push_back(triangle);
  }
  surface.W_.resize(static_cast<Eigen::Index>(entries.size()), whole.vertex_count());
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
  surface.first_cut_vertex_ = static_cast<int>(count);
  surface.W_.resize(static_cast<Eigen::Index>(count), mesh.vertex_count());
  surface.W_.setFromTriplets(entries.begin(), entries.end());
  return surface;
}

Surface Surface::subdivided(int levels) const {
  Subdivision fine = loop_subdivision(triangles_, vertex_count(), levels);
  Surface surface;
  surface.triangles_ = std::move(fine.triangles);
  surface.coarse_edges_ = std::move(fine.edges);
  surface.open_edges_ = fine.open_edges;
  surface.crease_edges_ = fine.crease_edges;
  surface.W_ = fine.stencil * W_;
  surface.first_cut_vertex_ = surface.vertex_count();
  surface.outside_count_ = outside_count_;
  surface.outside_ = outside_;
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
