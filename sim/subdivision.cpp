#include "sim/subdivision.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>

#include "sim/error.h"

namespace lagomorph::sim {
namespace {

using Stencil = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

struct SharedEdge {
  int a = 0, b = 0;             // a < b
  int first = -1, second = -1;  // opposite corners of its triangles
  int triangles = 0;
  bool is_smooth() const { return triangles == 2; }
};

/// A level's edges in ascending order of their ends, and those of each triangle, the k-th from corner k to k
/// + 1.
struct Topology {
  std::vector<SharedEdge> edges;
  std::vector<std::array<int, 3>> of_triangle;

  explicit Topology(const std::vector<Triangle>& triangles) : of_triangle(triangles.size()) {
    struct Side {
      int a, b;
      int triangle, corner;
    };
    std::vector<Side> sides;
    sides.reserve(3 * triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const auto [a, b] = std::minmax(triangles[t][i], triangles[t][(i + 1) % 3]);
        sides.push_back({a, b, static_cast<int>(t), k});
      }
    }
    std::stable_sort(sides.begin(), sides.end(),
                     [](const Side& x, const Side& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
    for (const Side& s : sides) {
      if (edges.empty() || edges.back().a != s.a || edges.back().b != s.b) edges.push_back({s.a, s.b});
      SharedEdge& edge = edges.back();
      const auto t = static_cast<std::size_t>(s.triangle), k = static_cast<std::size_t>(s.corner);
      (edge.triangles == 0 ? edge.first : edge.second) = triangles[t][(k + 2) % 3];
      ++edge.triangles;
      of_triangle[t][k] = static_cast<int>(edges.size()) - 1;
    }
  }

  int find(int a, int b) const {
    if (a > b) std::swap(a, b);
    const auto at = std::lower_bound(
        edges.begin(), edges.end(), std::pair(a, b),
        [](const SharedEdge& e, const auto& v) { return e.a != v.first ? e.a < v.first : e.b < v.second; });
    return static_cast<int>(at - edges.begin());
  }
};

/// b of a vertex of n edges.
double loop_weight(int n) {
  const double c = 0.375 + 0.25 * std::cos(2.0 * std::numbers::pi / n);
  return (0.625 - c * c) / n;
}

/// One level: rows of the old vertices, then of a new one an edge.
Stencil level_stencil(const Topology& topology, int vertex_count) {
  std::vector<std::vector<int>> around(static_cast<std::size_t>(vertex_count)), creases = around;
  for (const SharedEdge& e : topology.edges) {
    for (const auto& [at, other] : {std::pair(e.a, e.b), std::pair(e.b, e.a)}) {
      around[static_cast<std::size_t>(at)].push_back(other);
      if (!e.is_smooth()) creases[static_cast<std::size_t>(at)].push_back(other);
    }
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (int v = 0; v < vertex_count; ++v) {
    const std::vector<int>& ring = around[static_cast<std::size_t>(v)];
    const std::vector<int>& crease = creases[static_cast<std::size_t>(v)];
    if (crease.size() == 2) {
      entries.emplace_back(v, v, 0.75);
      for (const int w : crease) entries.emplace_back(v, w, 0.125);
    } else if (!crease.empty() || ring.empty()) {
      entries.emplace_back(v, v, 1.0);
    } else {
      const int n = static_cast<int>(ring.size());
      const double b = loop_weight(n);
      entries.emplace_back(v, v, 1.0 - n * b);
      for (const int w : ring) entries.emplace_back(v, w, b);
    }
  }
  int row = vertex_count;
  for (const SharedEdge& e : topology.edges) {
    const double end = e.is_smooth() ? 0.375 : 0.5;
    entries.emplace_back(row, e.a, end);
    entries.emplace_back(row, e.b, end);
    if (e.is_smooth()) {
      entries.emplace_back(row, e.first, 0.125);
      entries.emplace_back(row, e.second, 0.125);
    }
    ++row;
  }
  Stencil stencil(row, vertex_count);
  stencil.setFromTriplets(entries.begin(), entries.end());
  return stencil;
}

std::vector<Triangle> split_in_four(const std::vector<Triangle>& triangles, const Topology& topology,
                                    int vertex_count) {
  std::vector<Triangle> fine;
  fine.reserve(4 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = triangles[t];
    const int ab = vertex_count + topology.of_triangle[t][0], bc = vertex_count + topology.of_triangle[t][1],
              ca = vertex_count + topology.of_triangle[t][2];
    fine.insert(fine.end(),
                {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}});
  }
  return fine;
}

}  // namespace

Subdivision loop_subdivision(std::vector<Triangle> triangles, int vertex_count, int levels) {
  Subdivision fine;
  const std::int64_t count = static_cast<std::int64_t>(triangles.size()) << (2 * levels);
  if (count > most_subdivided_triangles) {
    throw InputError(std::to_string(levels) + " subdivisions of " + std::to_string(triangles.size()) +
                     " triangles give " + std::to_string(count) + "; at most " +
                     std::to_string(most_subdivided_triangles) + " can be drawn");
  }
  fine.triangles = std::move(triangles);
  fine.stencil.resize(vertex_count, vertex_count);
  fine.stencil.setIdentity();
  for (int level = 0; level < levels; ++level) {
    const int vertices = static_cast<int>(fine.stencil.rows());
    const Topology topology(fine.triangles);
    std::vector<std::array<int, 2>> halves;
    if (level == 0) {
      for (const SharedEdge& e : topology.edges) {
        fine.open_edges += e.triangles == 1 ? 1 : 0;
        fine.crease_edges += e.triangles > 2 ? 1 : 0;
        fine.edges.push_back({e.a, e.b});
      }
    }
    for (const auto& [a, b] : fine.edges) {
      const int middle = vertices + topology.find(a, b);
      halves.push_back({a, middle});
      halves.push_back({middle, b});
    }
    fine.edges = std::move(halves);
    fine.stencil = Stencil(level_stencil(topology, vertices) * fine.stencil);
    fine.triangles = split_in_four(fine.triangles, topology, vertices);
  }
  return fine;
}

}  // namespace lagomorph::sim
