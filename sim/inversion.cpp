#include "sim/inversion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sim/determinant.h"

namespace lagomorph::sim {

namespace {

struct Cubic {
  double c0, c1, c2, c3;
  double operator()(double t) const { return c0 + t * (c1 + t * (c2 + t * c3)); }
};

/// det(F + t dF) = det F + t cof F : dF + t² F : cof dF + t³ det dF.
Cubic determinant_along(const Mat3& F, const Mat3& dF) {
  return {determinant(F), cofactor(F).cwiseProduct(dF).sum(), F.cwiseProduct(cofactor(dF)).sum(),
          determinant(dF)};
}

/// Where the cubic turns, ascending; NaN when it does not.
std::array<double, 2> turning_points(const Cubic& p) {
  const double a = 3.0 * p.c3, half_b = p.c2, c = p.c1;
  const double w = -(half_b + std::copysign(std::sqrt(half_b * half_b - a * c), half_b));
  const double t1 = w / a, t2 = c / w;  // a = 0 leaves t2, the root of the linear equation
  return {std::fmin(t1, t2), std::fmax(t1, t2)};
}

/// Root of p between lo, where p > 0, and hi, where p <= 0. Bisection: some 50 halvings, but hardly any
/// element gets here.
double bisect(const Cubic& p, double lo, double hi) {
  for (;;) {
    const double middle = 0.5 * (lo + hi);
    if (!(middle > lo && middle < hi)) return lo;
    (p(middle) > 0.0 ? lo : hi) = middle;
  }
}

}  // namespace

double first_inversion(const Mat3& F, const Mat3& dF, double limit) {
  const Cubic p = determinant_along(F, dF);
  if (p.c0 - limit * (std::abs(p.c1) + limit * (std::abs(p.c2) + limit * std::abs(p.c3))) > 0.0)
    return std::numeric_limits<double>::infinity();
  // Between its turning points the cubic is monotone, so its sign at their ends tells whether there is a
  // root.
  double lo = 0.0;
  const auto [t1, t2] = turning_points(p);
  for (const double t : {t1, t2, limit}) {
    if (!(t > lo && t <= limit)) continue;
    if (p(t) <= 0.0) return bisect(p, lo, t);
    lo = t;
  }
  return std::numeric_limits<double>::infinity();
}

double step_without_inversion(const Mat3& F, const Mat3& dF) {
  return std::min(1.0, kInversionMargin * first_inversion(F, dF, 1.0 / kInversionMargin));
}

}  // namespace lagomorph::sim
