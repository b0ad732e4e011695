#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/settings.h"
#include "sim/tet_mesh.h"
#include "sim/types.h"

namespace lagomorph::sim {

/// Which of a vertex's coordinates x, y, z are meant.
using Axes = std::array<bool, 3>;
inline constexpr Axes kAllAxes = {true, true, true};

/// Coordinates that are held, and P, which drops them: q_free = P q, q = Pᵀ q_free + b, where b holds the
/// pinned positions and is zero elsewhere. (lecture, "Boundary conditions")
class Pins {
public:
  Pins() = default;
  /// Vertices held in all axes. They may repeat and be in any order; each must be in [0, vertex_count).
  Pins(int vertex_count, const std::vector<int>& vertices);
  /// Coordinates held one by one: `is_held[3 v + k]` of axis k of vertex v.
  explicit Pins(const std::vector<char>& is_held);

  const std::vector<int>& vertices() const { return vertices_; }            // held in some axis, ascending
  const std::vector<int>& free_vertices() const { return free_vertices_; }  // free in some axis, ascending
  int vertex_count() const { return static_cast<int>(free_index_.size()); }
  int free_dofs() const { return static_cast<int>(free_.size()); }
  bool is_held(int dof) const { return held_[static_cast<std::size_t>(dof)] != 0; }  // dof = 3 vertex + axis
  /// Whether the vertex is held in all axes.
  bool is_pinned(int vertex) const { return free_index(vertex) < 0; }
  /// Place of a vertex among the free ones, -1 when it is held in all axes.
  int free_index(int vertex) const { return free_index_[static_cast<std::size_t>(vertex)]; }

  VecX project(const VecX& full) const;      // P v, free_dofs
  VecX expand(const VecX& free) const;       // Pᵀ v_free, 3n, zero where pinned
  void clear_pinned(VecX& full) const;       // PᵀP v, in place
  VecX pinned_part(const VecX& full) const;  // v - PᵀP v
  double free_norm(const VecX& full) const;  // |P v|
  SparseMatrix matrix() const;               // P, free_dofs×3n

private:
  std::vector<char> held_;  // of each coordinate
  std::vector<int> free_;   // coordinates that are not, ascending
  std::vector<int> vertices_, free_vertices_, free_index_;
};

/// Vertices of one body, as indices into it, that are selected: the union, ascending. `X` are the body's
/// placed rest positions. Throws InputError, prefixed by `where`, when a selector is malformed or selects
/// nothing.
std::vector<int> select_vertices(const Points& X, const Selector&, const std::string& where);

}  // namespace lagomorph::sim
