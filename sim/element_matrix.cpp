#include "sim/element_matrix.h"

#include "sim/tet_gather.h"

namespace lagomorph::sim {

void element_blocks(const Mat9& h, const Mat3& D123, double* blocks) {
  const auto block = [&](int a, int b) { return Eigen::Map<Mat3>(blocks + 9 * TetGather::pair(a, b)); };
  for (int b = 1; b < 4; ++b) {
    // Columns of h B for corner b: column r sums h's columns 3r + l weighted by D_bl.
    Eigen::Matrix<double, 9, 3> hB;
    for (int r = 0; r < 3; ++r) hB.col(r) = h.middleCols<3>(3 * r) * D123.row(b - 1).transpose();
    for (int a = 1; a <= b; ++a)
      for (int r = 0; r < 3; ++r) block(a, b).row(r) = D123.row(a - 1) * hB.middleRows<3>(3 * r);
  }
  block(0, 1) = -(block(1, 1) + block(1, 2).transpose() + block(1, 3).transpose());
  block(0, 2) = -(block(1, 2) + block(2, 2) + block(2, 3).transpose());
  block(0, 3) = -(block(1, 3) + block(2, 3) + block(3, 3));
  block(0, 0) = -(block(0, 1) + block(0, 2) + block(0, 3));
}

}  // namespace lagomorph::sim
