#pragma once

#include <vector>

#include "sim/tet_mesh.h"
#include "sim/types.h"

namespace lagomorph::sim {

/// How far each vertex' surroundings are turned: the rotation R of the polar decomposition F = R S of the
/// mean deformation gradient of its tets (of their corners where they are quadratic), weighed by their
/// volumes at rest. The identity where that is singular, inverted or far from a rotation. `q`: positions, 3n
/// [m].
struct VertexRotations {
  std::vector<Mat3> R;
  double strain = 0.0;  // root of the mean of |S - I|² over the vertices
};
VertexRotations vertex_rotations(const TetMesh&, const VecX& q);

/// The rotation nearest to a matrix of positive determinant, by Newton's iteration R ← (R + R⁻ᵀ)/2
/// [Higham 1986]; the identity where it does not get there.
Mat3 nearest_rotation(const Mat3&);

}  // namespace lagomorph::sim
