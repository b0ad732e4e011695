#include "sim/tet_lanes.h"

#include <algorithm>
#include <cmath>

#include "sim/compensated_sum.h"
#include "sim/determinant.h"
#include "sim/simd.h"
#include "sim/tet_gather.h"

namespace lagomorph::sim {

namespace {

using Double8 = double __attribute__((vector_size(64), may_alias));
using Rows4 = double __attribute__((vector_size(32), aligned(8), may_alias));
using Choice8 = long long __attribute__((vector_size(64), may_alias));

constexpr std::size_t kMatrixSize = TetGather::matrix_size(4);
/// Part of the numbers that J and cof F are differences of, below which these are taken in twice the
/// precision.
constexpr double kSmallJ = 0.1, kSmallCofactorSquared = 1e-3;

constexpr long long kNoSign = 0x7fffffffffffffff;  // bits of a double

inline const Double8& lanes(const TetLanes::Lane& x) { return *reinterpret_cast<const Double8*>(x.data()); }
inline Double8& lanes(TetLanes::Lane& x) { return *reinterpret_cast<Double8*>(x.data()); }

/// Of eight tets, `hard` negative for the ones whose J or cof F is a small difference of large products.
LAGOMORPH_SIMD void deform_lanes(const TetLanes::Group& group, const double* q, TetLanes::Deformation& out,
                                 Choice8& hard) {
  Double8 x[4][3];
#pragma GCC unroll 4
  for (std::size_t a = 0; a < 4; ++a) {
    const std::array<int, 8>& n = group.first_dofs[a];
#pragma GCC unroll 3
    for (int r = 0; r < 3; ++r)
      x[a][r] = Double8{q[n[0] + r], q[n[1] + r], q[n[2] + r], q[n[3] + r],
                        q[n[4] + r], q[n[5] + r], q[n[6] + r], q[n[7] + r]};
  }
  Double8 F[3][3], I_C = {};
#pragma GCC unroll 3
  for (std::size_t r = 0; r < 3; ++r) {
    const Double8 x1 = x[1][r] - x[0][r], x2 = x[2][r] - x[0][r], x3 = x[3][r] - x[0][r];
#pragma GCC unroll 3
    for (std::size_t k = 0; k < 3; ++k) {
      F[r][k] = x1 * lanes(group.D[k]) + x2 * lanes(group.D[3 + k]) + x3 * lanes(group.D[6 + k]);
      I_C += F[r][k] * F[r][k];
      lanes(out.F[3 * r + k]) = F[r][k];
    }
  }
  Double8 J = {}, magnitude = {}, squared = {};
#pragma GCC unroll 3
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3;
#pragma GCC unroll 3
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const Double8 p = F[i1][j1] * F[i2][j2], m = F[i1][j2] * F[i2][j1], G = p - m;
      squared += G * G;
      lanes(out.G[3 * i + j]) = G;
      if (i != 0) continue;
      const Double8 Fp = F[0][j] * p, Fm = F[0][j] * m;
      J += F[0][j] * G;
      magnitude += reinterpret_cast<Double8>(reinterpret_cast<Choice8>(Fp) & kNoSign) +
                   reinterpret_cast<Double8>(reinterpret_cast<Choice8>(Fm) & kNoSign);
    }
  }
  lanes(out.I_C) = I_C;
  lanes(out.J) = J;
  // By their signs: GCC 12 takes a comparison of so many lanes apart.
  hard = reinterpret_cast<Choice8>(reinterpret_cast<Double8>(reinterpret_cast<Choice8>(J) & kNoSign) -
                                   kSmallJ * magnitude) |
         reinterpret_cast<Choice8>(squared - kSmallCofactorSquared * I_C * I_C);
}

void deform_precisely(std::size_t lane, TetLanes::Deformation& out) {
  Mat3 F;
  for (std::size_t i = 0; i < 9; ++i) F(static_cast<int>(i) / 3, static_cast<int>(i) % 3) = out.F[i][lane];
  const Mat3 G = cofactor(F);
  for (std::size_t i = 0; i < 9; ++i) out.G[i][lane] = G(static_cast<int>(i) / 3, static_cast<int>(i) % 3);
  out.J[lane] = determinant(F);
}

/// Four rows of a number of each of eight tets become columns of it: to[stride · tet + row].
inline __attribute__((always_inline)) void transpose4(const double* from, double* to, std::size_t stride) {
  for (std::size_t half = 0; half < 8; half += 4) {
    const Rows4 r0 = *reinterpret_cast<const Rows4*>(from + half),
                r1 = *reinterpret_cast<const Rows4*>(from + half + 8),
                r2 = *reinterpret_cast<const Rows4*>(from + half + 16),
                r3 = *reinterpret_cast<const Rows4*>(from + half + 24);
    const Rows4 a = __builtin_shufflevector(r0, r1, 0, 4, 2, 6),
                b = __builtin_shufflevector(r0, r1, 1, 5, 3, 7),
                c = __builtin_shufflevector(r2, r3, 0, 4, 2, 6),
                d = __builtin_shufflevector(r2, r3, 1, 5, 3, 7);
    double* out = to + half * stride;
    *reinterpret_cast<Rows4*>(out) = __builtin_shufflevector(a, c, 0, 1, 4, 5);
    *reinterpret_cast<Rows4*>(out + stride) = __builtin_shufflevector(b, d, 0, 1, 4, 5);
    *reinterpret_cast<Rows4*>(out + 2 * stride) = __builtin_shufflevector(a, c, 2, 3, 6, 7);
    *reinterpret_cast<Rows4*>(out + 3 * stride) = __builtin_shufflevector(b, d, 2, 3, 6, 7);
  }
}

/// ∂ψ/∂F = 2 ψ_I F + ψ_J cof F.
LAGOMORPH_SIMD void set_vector_lanes(const TetLanes::Group& group, const TetLanes::Deformation& at,
                                     const TetLanes::Derivatives& d, double* vectors) {
  const Double8 by_F = 2.0 * lanes(group.volumes) * lanes(d.I), by_G = lanes(group.volumes) * lanes(d.J);
  alignas(64) double rows[12 * 8];
  const auto row = [&](std::size_t i) { return reinterpret_cast<Double8*>(rows + 8 * i); };
#pragma GCC unroll 3
  for (std::size_t r = 0; r < 3; ++r) {
    Double8 P[3], sum = {};
#pragma GCC unroll 3
    for (std::size_t k = 0; k < 3; ++k) P[k] = by_F * lanes(at.F[3 * r + k]) + by_G * lanes(at.G[3 * r + k]);
#pragma GCC unroll 3
    for (std::size_t a = 0; a < 3; ++a) {
      const Double8 g =
          P[0] * lanes(group.D[3 * a]) + P[1] * lanes(group.D[3 * a + 1]) + P[2] * lanes(group.D[3 * a + 2]);
      *row(3 * (a + 1) + r) = g;
      sum += g;
    }
    *row(r) = -sum;
  }
  for (std::size_t i = 0; i < 12; i += 4) transpose4(rows + 8 * i, vectors + i, 12);
}

/// The formulas of add_invariant_blocks() and complete_blocks().
LAGOMORPH_SIMD void set_matrix_lanes(const TetLanes::Group& group, const TetLanes::Deformation& at,
                                     const TetLanes::Derivatives& d, double* matrices) {
  alignas(64) double rows[kMatrixSize * 8];
  // Entry (r, c) of block (a, b).
  const auto K = [&](int a, int b, std::size_t r, std::size_t c) {
    return reinterpret_cast<Double8*>(rows +
                                      8 * (9 * static_cast<std::size_t>(TetGather::pair(a, b)) + 3 * c + r));
  };
  const Double8 volume = lanes(group.volumes);
  const Double8 II = 4.0 * volume * lanes(d.II), IJ = 2.0 * volume * lanes(d.IJ), JJ = volume * lanes(d.JJ),
                I = 2.0 * volume * lanes(d.I), by_J = volume * lanes(d.J);
  Double8 u[3][3], w[3][3];
#pragma GCC unroll 3
  for (std::size_t a = 0; a < 3; ++a) {
#pragma GCC unroll 3
    for (std::size_t r = 0; r < 3; ++r) {
      const Double8 D0 = lanes(group.D[3 * a]), D1 = lanes(group.D[3 * a + 1]),
                    D2 = lanes(group.D[3 * a + 2]);
      u[a][r] = lanes(at.F[3 * r]) * D0 + lanes(at.F[3 * r + 1]) * D1 + lanes(at.F[3 * r + 2]) * D2;
      w[a][r] = lanes(at.G[3 * r]) * D0 + lanes(at.G[3 * r + 1]) * D1 + lanes(at.G[3 * r + 2]) * D2;
    }
  }
#pragma GCC unroll 3
  for (std::size_t b = 0; b < 3; ++b) {
    const Double8* Db = &lanes(group.D[3 * b]);
    Double8 by_u[3], by_w[3];
#pragma GCC unroll 3
    for (std::size_t c = 0; c < 3; ++c) {
      by_u[c] = II * u[b][c] + IJ * w[b][c];
      by_w[c] = IJ * u[b][c] + JJ * w[b][c];
    }
#pragma GCC unroll 3
    for (std::size_t a = 0; a <= b; ++a) {
      const Double8* Da = &lanes(group.D[3 * a]);
      const Double8 diagonal = I * (Da[0] * Db[0] + Da[1] * Db[1] + Da[2] * Db[2]);
      Double8 block[3][3];
#pragma GCC unroll 3
      for (std::size_t r = 0; r < 3; ++r)
#pragma GCC unroll 3
        for (std::size_t c = 0; c < 3; ++c) block[r][c] = u[a][r] * by_u[c] + w[a][r] * by_w[c];
#pragma GCC unroll 3
      for (std::size_t r = 0; r < 3; ++r) block[r][r] += diagonal;
      if (a != b) {
        const Double8 n0 = by_J * (Da[1] * Db[2] - Da[2] * Db[1]),
                      n1 = by_J * (Da[2] * Db[0] - Da[0] * Db[2]),
                      n2 = by_J * (Da[0] * Db[1] - Da[1] * Db[0]);
#pragma GCC unroll 3
        for (std::size_t t = 0; t < 3; ++t) {
          const Double8 c =
              lanes(at.F[3 * t]) * n0 + lanes(at.F[3 * t + 1]) * n1 + lanes(at.F[3 * t + 2]) * n2;
          block[(t + 1) % 3][(t + 2) % 3] += c;
          block[(t + 2) % 3][(t + 1) % 3] -= c;
        }
      }
#pragma GCC unroll 3
      for (std::size_t r = 0; r < 3; ++r)
#pragma GCC unroll 3
        for (std::size_t c = 0; c < 3; ++c)
          *K(static_cast<int>(a) + 1, static_cast<int>(b) + 1, r, c) = block[r][c];
    }
  }
#pragma GCC unroll 3
  for (std::size_t r = 0; r < 3; ++r) {
#pragma GCC unroll 3
    for (std::size_t c = 0; c < 3; ++c) {
      const Double8 of1 = *K(1, 1, r, c) + *K(1, 2, c, r) + *K(1, 3, c, r),
                    of2 = *K(1, 2, r, c) + *K(2, 2, r, c) + *K(2, 3, c, r),
                    of3 = *K(1, 3, r, c) + *K(2, 3, r, c) + *K(3, 3, r, c);
      *K(0, 1, r, c) = -of1;
      *K(0, 2, r, c) = -of2;
      *K(0, 3, r, c) = -of3;
      *K(0, 0, r, c) = of1 + of2 + of3;
    }
  }
  std::size_t i = 0;
  for (; i + 4 <= kMatrixSize; i += 4) transpose4(rows + 8 * i, matrices + i, kMatrixSize);
  for (; i < kMatrixSize; ++i)
    for (std::size_t lane = 0; lane < 8; ++lane) matrices[kMatrixSize * lane + i] = rows[8 * i + lane];
}

/// Eight sums and what rounding took from each.
LAGOMORPH_SIMD void sum_lanes(const TetLanes::Lane* values, std::size_t count, TetLanes::Lane& sums,
                              TetLanes::Lane& lost) {
  Double8 sum = {}, rest = {};
  for (std::size_t i = 0; i < count; ++i) {
    Double8 x;
    for (std::size_t lane = 0; lane < 8; ++lane) x[lane] = values[i][lane];
    const Double8 next = sum + x, added = next - sum;
    rest += (sum - (next - added)) + (x - added);
    sum = next;
  }
  for (std::size_t lane = 0; lane < 8; ++lane) {
    sums[lane] = sum[lane];
    lost[lane] = rest[lane];
  }
}

}  // namespace

TetLanes::TetLanes(const std::vector<ElementRule<4, 1>>& elements)
    : groups_((elements.size() + kLanes - 1) / kLanes) {
  for (std::size_t j = 0; j < kLanes * groups_.size(); ++j) {
    const ElementRule<4, 1>& e = elements[std::min(j, elements.size() - 1)];
    Group& group = groups_[j / kLanes];
    const std::size_t lane = j % kLanes;
    for (std::size_t i = 0; i < 9; ++i)
      group.D[i][lane] = e.D[0](static_cast<int>(i) / 3, static_cast<int>(i) % 3);
    group.volumes[lane] = j < elements.size() ? e.volumes[0] : 0.0;
    for (std::size_t a = 0; a < 4; ++a) group.first_dofs[a][lane] = 3 * e.nodes[a];
  }
}

void TetLanes::deform(std::size_t group, const VecX& q, Deformation& out) const {
  Choice8 hard;
  deform_lanes(groups_[group], q.data(), out, hard);
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    if (hard[lane] < 0) deform_precisely(lane, out);
}

void TetLanes::set_vectors(std::size_t group, const Deformation& at, const Derivatives& d,
                           double* vectors) const {
  set_vector_lanes(groups_[group], at, d, vectors);
}

void TetLanes::set_matrices(std::size_t group, const Deformation& at, const Derivatives& d,
                            double* matrices) const {
  set_matrix_lanes(groups_[group], at, d, matrices);
}

double TetLanes::sum(const std::vector<Lane>& values) {
  Lane sums, lost;
  sum_lanes(values.data(), values.size(), sums, lost);
  CompensatedSum total;
  for (const double x : sums) total.add(x);
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    if (std::isfinite(sums[lane])) total.add(lost[lane]);
  return total.value();
}

}  // namespace lagomorph::sim
