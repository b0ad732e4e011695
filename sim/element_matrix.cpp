#include "sim/element_matrix.h"

#include "sim/tet_gather.h"

namespace lagomorph::sim {

namespace {

Eigen::Map<Mat3> block(double* blocks, int a, int b) {
  return Eigen::Map<Mat3>(blocks + 9 * static_cast<std::ptrdiff_t>(TetGather::pair(a, b)));
}

}  // namespace

template <int N>
void add_inner_blocks(const Mat9& h, const InnerGradients<N>& D, double* blocks) {
  for (int b = 1; b < N; ++b) {
    // Columns of h B for node b: column r sums h's columns 3r + l weighted by D_bl.
    Eigen::Matrix<double, 9, 3> hB;
    for (int r = 0; r < 3; ++r) hB.col(r) = h.middleCols<3>(3 * r) * D.row(b - 1).transpose();
    for (int a = 1; a <= b; ++a)
      for (int r = 0; r < 3; ++r)
        block(blocks, a, b).row(r) += (D.row(a - 1) * hB.template middleRows<3>(3 * r)).eval();
  }
}

template <int N>
void complete_blocks(double* blocks) {
  Mat3 first = Mat3::Zero();
  for (int b = 1; b < N; ++b) {
    Mat3 sum = block(blocks, 1, b);
    for (int a = 2; a < N; ++a) {
      if (a <= b) {
        sum += block(blocks, a, b);
      } else {
        sum += block(blocks, b, a).transpose();
      }
    }
    block(blocks, 0, b) = -sum;
    first += block(blocks, 0, b);
  }
  block(blocks, 0, 0) = -first;
}

template void add_inner_blocks<4>(const Mat9&, const InnerGradients<4>&, double*);
template void add_inner_blocks<10>(const Mat9&, const InnerGradients<10>&, double*);
template void complete_blocks<4>(double*);
template void complete_blocks<10>(double*);

}  // namespace lagomorph::sim
