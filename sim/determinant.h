#pragma once

#include <cmath>

#include "sim/types.h"

/// det F and its derivatives, to full precision also where F is nearly singular: there J is the small
/// difference of large products, and J^(-2/3) would magnify their rounding. Where the difference is small it
/// is taken in twice the precision.
namespace lagomorph::sim {

/// An unevaluated sum hi + lo. [Dekker 1971, "A floating-point technique for extending the available
/// precision"]
struct DoubleDouble {
  double hi = 0.0, lo = 0.0;
};

inline DoubleDouble two_sum(double a, double b) {
  const double s = a + b, bb = s - a;
  return {s, (a - (s - bb)) + (b - bb)};
}

inline DoubleDouble two_product(double a, double b) {
  constexpr double kSplit = 134217729.0;  // 2^27 + 1
  const double p = a * b;
  const double ta = kSplit * a, a_hi = ta - (ta - a), a_lo = a - a_hi;
  const double tb = kSplit * b, b_hi = tb - (tb - b), b_lo = b - b_hi;
  return {p, ((a_hi * b_hi - p) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo};
}

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble s = two_sum(a.hi, b.hi);
  const double lo = s.lo + (a.lo + b.lo), hi = s.hi + lo;
  return {hi, lo - (hi - s.hi)};
}

/// ab - cd in twice the precision.
inline DoubleDouble precise_difference_of_products(double a, double b, double c, double d) {
  return two_product(a, b) + two_product(-c, d);
}

/// ab - cd, to the last digits.
inline double difference_of_products(double a, double b, double c, double d) {
  const double ab = a * b, cd = c * d, difference = ab - cd;
  if (std::abs(difference) >= 0.1 * (std::abs(ab) + std::abs(cd))) return difference;
  return precise_difference_of_products(a, b, c, d).hi;
}

/// Cofactors of F: ∂J/∂F, and J F⁻ᵀ where J is not zero.
inline Mat3 cofactor(const Mat3& F) {
  Mat3 cof;
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      cof(i, j) = difference_of_products(F(i1, j1), F(i2, j2), F(i1, j2), F(i2, j1));
    }
  }
  return cof;
}

/// J = det F.
inline double determinant(const Mat3& F) {
  double sum = 0.0, magnitude = 0.0;
  for (int j = 0; j < 3; ++j) {
    const double p = F(0, j) * F(1, (j + 1) % 3) * F(2, (j + 2) % 3);
    const double m = F(0, j) * F(1, (j + 2) % 3) * F(2, (j + 1) % 3);
    sum += p - m;
    magnitude += std::abs(p) + std::abs(m);
  }
  if (!(std::abs(sum) < 0.1 * magnitude)) return sum;
  DoubleDouble precise;
  for (int j = 0; j < 3; ++j) {
    const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    const DoubleDouble cof = precise_difference_of_products(F(1, j1), F(2, j2), F(1, j2), F(2, j1));
    precise = precise + (two_product(F(0, j), cof.hi) + DoubleDouble{F(0, j) * cof.lo, 0.0});
  }
  return precise.hi;
}

/// The entries of ∂²J/∂F², 9×9 over row-major vec(F), are those of F up to sign:
/// ∂²J/∂F_ij∂F_kl = Σ_mn ε_ikm ε_jln F_mn. Calls add(3i+j, 3k+l, value) for each entry that is not zero by
/// structure.
template <class Add>
inline void for_each_second_derivative_of_J(const Mat3& F, Add&& add) {
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      if (i == k) continue;
      const int m = 3 - i - k;
      const double row_sign = (k - i + 3) % 3 == 1 ? 1.0 : -1.0;
      for (int j = 0; j < 3; ++j) {
        for (int l = 0; l < 3; ++l) {
          if (j == l) continue;
          const double sign = (l - j + 3) % 3 == 1 ? row_sign : -row_sign;
          add(3 * i + j, 3 * k + l, sign * F(m, 3 - j - l));
        }
      }
    }
  }
}

}  // namespace lagomorph::sim
