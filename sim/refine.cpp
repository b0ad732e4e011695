#include "sim/refine.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "sim/mesh_check.h"

namespace lagomorph::sim {

namespace {

/// The nodes in the middle of a mesh's edges, made as they are asked for.
class EdgeNodes {
public:
  explicit EdgeNodes(const Points& X) : X_(X), next_(static_cast<int>(X.rows())) {}

  void set(int a, int b, int node) { nodes_.emplace(key(a, b), node); }
  int get(int a, int b) {
    const auto [place, is_new] = nodes_.try_emplace(key(a, b), next_);
    if (is_new) {
      ++next_;
      added_.emplace_back(0.5 * (X_.row(std::min(a, b)) + X_.row(std::max(a, b))));
    }
    return place->second;
  }
  /// All points: those of the mesh, then those that were made.
  Points points() const {
    Points all(next_, 3);
    all.topRows(X_.rows()) = X_;
    for (std::size_t i = 0; i < added_.size(); ++i)
      all.row(X_.rows() + static_cast<Eigen::Index>(i)) = added_[i];
    return all;
  }

private:
  static std::uint64_t key(int a, int b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
  }

  const Points& X_;
  int next_;
  std::unordered_map<std::uint64_t, int> nodes_;
  std::vector<Eigen::RowVector3d> added_;
};

Midsides midsides_of(const Tet& tet, EdgeNodes& nodes) {
  Midsides midsides;
  for (std::size_t e = 0; e < 6; ++e) {
    const auto& [a, b] = kTetEdges[e];
    midsides[e] = nodes.get(tet[static_cast<std::size_t>(a)], tet[static_cast<std::size_t>(b)]);
  }
  return midsides;
}

void cover_all(TetMesh& mesh) {
  assert(mesh.bodies.size() <= 1);
  for (Body& body : mesh.bodies) {
    body.vertices = {0, mesh.vertex_count()};
    body.tets = {0, mesh.tet_count()};
  }
}

/// The octahedron between the midside nodes: each diagonal, and the four nodes around it such that tets of
/// the diagonal and two that follow each other are positively oriented. By edges of kTetEdges.
struct Diagonal {
  std::array<std::size_t, 2> ends;
  std::array<std::size_t, 4> around;
};
constexpr std::array<Diagonal, 3> kDiagonals = {
    {{{2, 5}, {0, 1, 4, 3}}, {{0, 4}, {1, 2, 3, 5}}, {{1, 3}, {0, 5, 4, 2}}}};

void split(const Tet& t, const Midsides& m, const Points& X, std::vector<Tet>& tets) {
  tets.push_back({t[0], m[0], m[2], m[3]});
  tets.push_back({m[0], t[1], m[1], m[5]});
  tets.push_back({m[2], m[1], t[2], m[4]});
  tets.push_back({m[3], m[5], m[4], t[3]});
  const auto length = [&](const Diagonal& d) {
    return (X.row(m[d.ends[0]]) - X.row(m[d.ends[1]])).squaredNorm();
  };
  const Diagonal* shortest = &kDiagonals[0];
  for (const Diagonal& d : kDiagonals)
    if (length(d) < (1.0 - 1e-9) * length(*shortest)) shortest = &d;  // equal ones: the first
  for (std::size_t i = 0; i < 4; ++i)
    tets.push_back({m[shortest->ends[0]], m[shortest->ends[1]], m[shortest->around[i]],
                    m[shortest->around[(i + 1) % 4]]});
}

}  // namespace

TetMesh with_quadratic_tets(const TetMesh& mesh) {
  if (!mesh.midsides.empty()) return mesh;
  TetMesh result = mesh;
  EdgeNodes nodes(mesh.X);
  for (const Tet& tet : mesh.tets) result.midsides.push_back(midsides_of(tet, nodes));
  result.X = nodes.points();
  cover_all(result);
  return result;
}

TetMesh with_linear_tets(const TetMesh& mesh) {
  TetMesh result = mesh;
  result.midsides.clear();
  if (!mesh.midsides.empty()) drop_stray_vertices(result);
  return result;
}

TetMesh refined(const TetMesh& mesh) {
  EdgeNodes nodes(mesh.X);
  for (std::size_t j = 0; j < mesh.midsides.size(); ++j)
    for (std::size_t e = 0; mesh.is_quadratic(j) && e < 6; ++e)
      nodes.set(mesh.tets[j][static_cast<std::size_t>(kTetEdges[e][0])],
                mesh.tets[j][static_cast<std::size_t>(kTetEdges[e][1])], mesh.midsides[j][e]);
  std::vector<Midsides> midsides;
  for (const Tet& tet : mesh.tets) midsides.push_back(midsides_of(tet, nodes));
  TetMesh result;
  result.X = nodes.points();
  result.bodies = mesh.bodies;
  for (std::size_t j = 0; j < mesh.tets.size(); ++j) {
    split(mesh.tets[j], midsides[j], result.X, result.tets);
    result.tags.resize(result.tets.size(), mesh.tags[j]);
  }
  cover_all(result);
  return mesh.midsides.empty() ? result : with_quadratic_tets(result);
}

}  // namespace lagomorph::sim
