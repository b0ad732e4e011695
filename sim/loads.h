#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/mass.h"
#include "sim/settings.h"
#include "sim/tet_mesh.h"
#include "sim/types.h"

namespace lagomorph::sim {

/// A factor of time: linear between its points (t, factor), constant outside; 1 without any.
double curve_at(const std::vector<std::array<double, 2>>& curve, double t);

/// Dead loads: forces on the vertices that are functions of time alone.
class Loads {
public:
  /// Adds those of a body of the mesh. Throws InputError, prefixed by `where`.
  void append(const TetMesh&, const Body&, const BodySettings&, const BodyMass&, const std::string& where);
  bool is_empty() const { return loads_.empty(); }
  /// f(t), 3n; empty when there are no loads. [N]
  VecX force(double t) const;

private:
  struct Load {
    VecX f;  // of the body's vertices [N]
    int first_vertex = 0;
    std::vector<std::array<double, 2>> curve;
  };
  std::vector<Load> loads_;
  int vertex_count_ = 0;
};

}  // namespace lagomorph::sim
