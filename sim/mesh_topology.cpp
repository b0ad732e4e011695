#include "sim/mesh_topology.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>

#include "sim/mesh_check.h"

namespace lagomorph::sim {
namespace {

/// Items in buckets by a vertex: a counting sort that keeps the order within.
template <typename Item>
struct Buckets {
  std::vector<std::size_t> begin;  // one more than vertices
  std::vector<Item> items;
};

template <typename Item, typename Key, typename Make>
Buckets<Item> bucket(std::size_t item_count, std::size_t vertex_count, Key key, Make make) {
  Buckets<Item> buckets;
  buckets.begin.assign(vertex_count + 1, 0);
  for (std::size_t i = 0; i < item_count; ++i) ++buckets.begin[static_cast<std::size_t>(key(i)) + 1];
  std::partial_sum(buckets.begin.begin(), buckets.begin.end(), buckets.begin.begin());
  std::vector<std::size_t> next(buckets.begin.begin(), buckets.begin.end() - 1);
  buckets.items.resize(item_count);
  for (std::size_t i = 0; i < item_count; ++i)
    buckets.items[next[static_cast<std::size_t>(key(i))]++] = make(i);
  return buckets;
}

/// A face under its smallest vertex.
struct FaceKey {
  int middle, largest;
  int face;
  bool even;  // parity of its corners' order
  bool same(const FaceKey& other) const { return middle == other.middle && largest == other.largest; }
};

FaceKey face_key(Triangle corners, int face) {
  bool even = true;
  if (corners[0] > corners[1]) std::swap(corners[0], corners[1]), even = !even;
  if (corners[1] > corners[2]) std::swap(corners[1], corners[2]), even = !even;
  if (corners[0] > corners[1]) even = !even, std::swap(corners[0], corners[1]);
  return {corners[1], corners[2], face, even};
}

/// An edge of a triangle under its smaller vertex.
struct EdgeKey {
  int larger;
  int corner;    // 3 t + k: the edge from corner k to corner k + 1 of triangle t
  bool forward;  // from the smaller to the larger vertex
};

int find_root(std::vector<int>& parent, int i) {
  while (parent[static_cast<std::size_t>(i)] != i) {
    int& p = parent[static_cast<std::size_t>(i)];
    p = parent[static_cast<std::size_t>(p)];
    i = p;
  }
  return i;
}

void unite(std::vector<int>& parent, int a, int b) {
  a = find_root(parent, a);
  b = find_root(parent, b);
  parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
}

void add(SurfaceTopology::Edges& edges, int a, int b) {
  if (edges.count++ == 0) edges.a = a, edges.b = b;
}

std::uint64_t mix(std::uint64_t x) {
  x ^= x >> 31;
  x *= 0x9e3779b97f4a7c15u;
  return x ^ (x >> 29);
}

}  // namespace

FaceMatch match_faces(const TetMesh& mesh, Range tets) {
  const std::size_t face_count = 4 * static_cast<std::size_t>(tets.size());
  const auto corners = [&](std::size_t face) {
    return tet_face(mesh.tets[static_cast<std::size_t>(tets.begin) + face / 4], static_cast<int>(face % 4));
  };
  Buckets<FaceKey> buckets = bucket<FaceKey>(
      face_count, static_cast<std::size_t>(mesh.vertex_count()),
      [&](std::size_t face) {
        const Triangle c = corners(face);
        return std::min({c[0], c[1], c[2]});
      },
      [&](std::size_t face) { return face_key(corners(face), static_cast<int>(face)); });
  FaceMatch match;
  match.other.assign(face_count, FaceMatch::kBoundary);
  const auto remember_first = [](int& first, int face) { first = first < 0 ? face : std::min(first, face); };
  for (std::size_t v = 0; v + 1 < buckets.begin.size(); ++v) {
    const auto begin = buckets.items.begin() + static_cast<std::ptrdiff_t>(buckets.begin[v]);
    const auto end = buckets.items.begin() + static_cast<std::ptrdiff_t>(buckets.begin[v + 1]);
    std::sort(begin, end, [](const FaceKey& a, const FaceKey& b) {
      return std::tie(a.middle, a.largest, a.face) < std::tie(b.middle, b.largest, b.face);
    });
    for (auto run = begin; run != end;) {
      const auto run_end = std::find_if(run, end, [&](const FaceKey& key) { return !key.same(*run); });
      if (run_end - run == 2) {
        match.other[static_cast<std::size_t>(run[0].face)] = run[1].face;
        match.other[static_cast<std::size_t>(run[1].face)] = run[0].face;
        if (run[0].even == run[1].even) remember_first(match.first_same_side, run[0].face);
      } else if (run_end - run > 2) {
        for (auto key = run; key != run_end; ++key)
          match.other[static_cast<std::size_t>(key->face)] = FaceMatch::kCrowded;
        remember_first(match.first_crowded, run->face);
      }
      run = run_end;
    }
  }
  return match;
}

SurfaceTopology surface_topology(const std::vector<Triangle>& triangles, int vertex_count) {
  const std::size_t corner_count = 3 * triangles.size();
  const auto from = [&](std::size_t corner) { return triangles[corner / 3][corner % 3]; };
  const auto to = [&](std::size_t corner) { return triangles[corner / 3][(corner % 3 + 1) % 3]; };
  Buckets<EdgeKey> buckets = bucket<EdgeKey>(
      corner_count, static_cast<std::size_t>(vertex_count),
      [&](std::size_t corner) { return std::min(from(corner), to(corner)); },
      [&](std::size_t corner) {
        return EdgeKey{std::max(from(corner), to(corner)), static_cast<int>(corner),
                       from(corner) < to(corner)};
      });
  SurfaceTopology topology;
  // Corners at one vertex belong to one fan when their triangles share an edge there.
  std::vector<int> fan(corner_count);
  std::iota(fan.begin(), fan.end(), 0);
  const auto next = [](int corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
  for (std::size_t v = 0; v + 1 < buckets.begin.size(); ++v) {
    const auto begin = buckets.items.begin() + static_cast<std::ptrdiff_t>(buckets.begin[v]);
    const auto end = buckets.items.begin() + static_cast<std::ptrdiff_t>(buckets.begin[v + 1]);
    std::sort(begin, end, [](const EdgeKey& a, const EdgeKey& b) {
      return std::tie(a.larger, a.corner) < std::tie(b.larger, b.corner);
    });
    for (auto run = begin; run != end;) {
      const auto run_end =
          std::find_if(run, end, [&](const EdgeKey& key) { return key.larger != run->larger; });
      const int a = static_cast<int>(v);
      if (run_end - run == 1) add(topology.open, a, run->larger);
      if (run_end - run > 2) add(topology.crowded, a, run->larger);
      if (run_end - run == 2 && run[0].forward == run[1].forward) add(topology.inconsistent, a, run->larger);
      for (auto key = run + 1; key != run_end; ++key) {
        const bool same_sense = key->forward == run->forward;
        unite(fan, run->corner, same_sense ? key->corner : next(key->corner));
        unite(fan, next(run->corner), same_sense ? next(key->corner) : key->corner);
      }
      run = run_end;
    }
  }
  std::vector<int> fans(static_cast<std::size_t>(vertex_count), 0);
  for (std::size_t corner = 0; corner < corner_count; ++corner) {
    if (fan[corner] == static_cast<int>(corner)) ++fans[static_cast<std::size_t>(from(corner))];
  }
  for (std::size_t v = 0; v < fans.size(); ++v) {
    if (fans[v] > 1 && topology.crowded_vertices++ == 0) topology.first_crowded_vertex = static_cast<int>(v);
  }
  return topology;
}

std::vector<int> first_equal_points(const Points& X) {
  const auto count = static_cast<std::size_t>(X.rows());
  const std::size_t slots = std::bit_ceil(2 * count + 1);
  std::vector<int> table(slots, -1);  // open addressing
  std::vector<int> first(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = X.row(static_cast<Eigen::Index>(i));
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis)
      hash = mix(hash ^ std::bit_cast<std::uint64_t>(row[axis] + 0.0));  // -0 + 0 = 0
    std::size_t slot = mix(hash) & (slots - 1);
    while (table[slot] >= 0 && X.row(table[slot]) != row) slot = (slot + 1) & (slots - 1);
    if (table[slot] < 0) table[slot] = static_cast<int>(i);
    first[i] = table[slot];
  }
  return first;
}

std::vector<Triangle> boundary_triangles(const TetMesh& mesh, const FaceMatch& match, Range tets) {
  std::vector<Triangle> triangles;
  for (std::size_t face = 0; face < match.other.size(); ++face) {
    if (match.other[face] != FaceMatch::kBoundary) continue;
    triangles.push_back(
        tet_face(mesh.tets[static_cast<std::size_t>(tets.begin) + face / 4], static_cast<int>(face % 4)));
  }
  return triangles;
}

int midside(const Midsides& midsides, int a, int b) {
  std::size_t e = 0;
  while (std::minmax(kTetEdges[e][0], kTetEdges[e][1]) != std::minmax(a, b)) ++e;
  return midsides[e];
}

std::vector<BoundaryFace> boundary_faces(const TetMesh& mesh, Range tets) {
  const FaceMatch match = match_faces(mesh, tets);
  std::vector<BoundaryFace> faces;
  for (std::size_t face = 0; face < match.other.size(); ++face) {
    if (match.other[face] != FaceMatch::kBoundary) continue;
    const std::size_t j = static_cast<std::size_t>(tets.begin) + face / 4;
    BoundaryFace& added =
        faces.emplace_back(BoundaryFace{tet_face(mesh.tets[j], static_cast<int>(face % 4)), {-1, -1, -1}});
    if (!mesh.is_quadratic(j)) continue;
    const auto& corner = kTetFaces[face % 4];
    for (std::size_t k = 0; k < 3; ++k)
      added.midsides[k] = midside(mesh.midsides[j], corner[k], corner[(k + 1) % 3]);
  }
  return faces;
}

void add_drawn(const BoundaryFace& face, std::vector<Triangle>& triangles) {
  const auto [a, b, c] = face.corners;
  const auto [ab, bc, ca] = face.midsides;
  if (ab < 0) {
    triangles.push_back(face.corners);
  } else {
    triangles.insert(triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
}

std::vector<Triangle> drawn_boundary(const TetMesh& mesh, Range tets) {
  std::vector<Triangle> triangles;
  for (const BoundaryFace& face : boundary_faces(mesh, tets)) add_drawn(face, triangles);
  return triangles;
}

std::vector<Triangle> boundary_triangles(const TetMesh& mesh, Range tets) {
  return boundary_triangles(mesh, match_faces(mesh, tets), tets);
}

}  // namespace lagomorph::sim
