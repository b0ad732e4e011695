#pragma once

#include <string>
#include <vector>

#include "sim/settings.h"
#include "sim/tet_mesh.h"
#include "sim/types.h"

namespace lagomorph::sim {

/// Vertices that are held, and P, which drops their coordinates: q_free = P q, q = Pᵀ q_free + b, where b
/// holds the pinned positions and is zero elsewhere. (lecture, "Boundary conditions")
class Pins {
public:
  Pins() = default;
  /// `vertices` may repeat and be in any order; each must be in [0, vertex_count).
  Pins(int vertex_count, const std::vector<int>& vertices);

  const std::vector<int>& vertices() const { return vertices_; }            // pinned, ascending
  const std::vector<int>& free_vertices() const { return free_vertices_; }  // the others, ascending
  int vertex_count() const { return static_cast<int>(free_index_.size()); }
  int free_dofs() const { return 3 * static_cast<int>(free_vertices_.size()); }
  bool is_pinned(int vertex) const { return free_index_[static_cast<std::size_t>(vertex)] < 0; }
  /// Place of a vertex among the free ones, -1 when it is pinned.
  int free_index(int vertex) const { return free_index_[static_cast<std::size_t>(vertex)]; }

  VecX project(const VecX& full) const;      // P v, free_dofs
  VecX expand(const VecX& free) const;       // Pᵀ v_free, 3n, zero where pinned
  void clear_pinned(VecX& full) const;       // PᵀP v, in place
  double free_norm(const VecX& full) const;  // |P v|
  SparseMatrix matrix() const;               // P, free_dofs×3n

private:
  std::vector<int> vertices_, free_vertices_, free_index_;
};

/// Vertices of one body, as indices into it, that a pin selects: the union of its selectors, ascending. `X`
/// are the body's placed rest positions. Throws InputError, prefixed by `where`, when a selector is malformed
/// or selects nothing.
std::vector<int> select_vertices(const Points& X, const PinSettings&, const std::string& where);

}  // namespace lagomorph::sim
