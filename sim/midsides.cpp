#include "sim/midsides.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "sim/error.h"
#include "sim/text.h"

namespace lagomorph::sim {

namespace {

constexpr double kStraight = 1e-4;  // of an edge's length; single precision has some 1e-6

struct Edge {
  int a, b, node;
};

Edge edge_of(const TetMesh& mesh, std::size_t j, std::size_t e) {
  const int a = mesh.tets[j][static_cast<std::size_t>(kTetEdges[e][0])];
  const int b = mesh.tets[j][static_cast<std::size_t>(kTetEdges[e][1])];
  return {std::min(a, b), std::max(a, b), mesh.midsides[j][e]};
}

std::string name_of(const std::string& origin, std::size_t j, const Edge& edge) {
  return origin + ": tet " + std::to_string(j) + ", edge from vertex " + std::to_string(edge.a) + " to " +
         std::to_string(edge.b) + " (all numbered from 0): ";
}

void check_indices(const TetMesh& mesh, const std::string& origin, std::size_t j) {
  std::array<int, 10> nodes;
  std::copy(mesh.tets[j].begin(), mesh.tets[j].end(), nodes.begin());
  std::copy(mesh.midsides[j].begin(), mesh.midsides[j].end(), nodes.begin() + 4);
  const std::string name = origin + ": tet " + std::to_string(j) + " (numbered from 0)";
  std::sort(nodes.begin(), nodes.end());
  for (const int node : nodes) {
    if (node < 0 || node >= mesh.vertex_count()) {
      throw InputError(name + " has midside node " + std::to_string(node) + "; it must be in 0.." +
                       std::to_string(mesh.vertex_count() - 1));
    }
  }
  const auto* twice = std::adjacent_find(nodes.begin(), nodes.end());
  if (twice != nodes.end())
    throw InputError(name + " has node " + std::to_string(*twice) + " twice; its ten nodes must differ");
}

void check_straight(const TetMesh& mesh, const std::string& origin, std::size_t j, const Edge& edge) {
  const Vec3 A = mesh.X.row(edge.a), B = mesh.X.row(edge.b), M = mesh.X.row(edge.node);
  const double off = (M - 0.5 * (A + B)).norm();
  if (off <= kStraight * (B - A).norm()) return;
  throw InputError(name_of(origin, j, edge) + "its midside node " + std::to_string(edge.node) + " lies " +
                   short_number(off) +
                   " m from the middle; quadratic tets must have straight edges (gmsh: "
                   "Mesh.SecondOrderLinear = 1)");
}

}  // namespace

void check_midsides(const TetMesh& mesh, const std::string& origin, const MeshChecks& checks) {
  if (mesh.midsides.empty()) return;
  if (mesh.midsides.size() != mesh.tets.size()) {
    throw InputError(origin + ": midside nodes of " + std::to_string(mesh.midsides.size()) + " tets for " +
                     std::to_string(mesh.tets.size()) + " tets");
  }
  std::unordered_map<std::uint64_t, int> node_of;
  for (std::size_t j = 0; j < mesh.tets.size(); ++j) {
    if (mesh.is_quadratic(j)) check_indices(mesh, origin, j);
    for (std::size_t e = 0; e < 6; ++e) {
      const Edge edge = edge_of(mesh, j, e);
      const std::uint64_t key = static_cast<std::uint64_t>(edge.a) << 32 | static_cast<std::uint32_t>(edge.b);
      const auto [other, is_new] = node_of.emplace(key, edge.node);
      const auto text = [](int node) { return node < 0 ? std::string("none") : std::to_string(node); };
      if (!is_new && other->second != edge.node) {
        throw InputError(name_of(origin, j, edge) + "its midside node is " + text(edge.node) +
                         ", in another tet " + text(other->second) + "; it must be the same in all");
      }
      if (checks.orientation && edge.node >= 0) check_straight(mesh, origin, j, edge);
    }
  }
}

void turn_tet(TetMesh& mesh, std::size_t tet) {
  std::swap(mesh.tets[tet][2], mesh.tets[tet][3]);
  if (!mesh.is_quadratic(tet)) return;
  std::swap(mesh.midsides[tet][1], mesh.midsides[tet][5]);
  std::swap(mesh.midsides[tet][2], mesh.midsides[tet][3]);
}

}  // namespace lagomorph::sim
