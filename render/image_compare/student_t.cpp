#include "render/image_compare/student_t.h"

#include <cmath>

namespace lagomorph::render {
namespace {

/// The continued fraction of the incomplete beta function [DLMF 8.17.22], by Lentz's method; converges
/// quickly for x < (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x) {
  constexpr double tiny = 1e-300, precision = 1e-15;
  constexpr int most_terms = 10000;
  const auto nonzero = [](double v) { return std::abs(v) < tiny ? tiny : v; };
  double c = 1.0;
  double d = 1.0 / nonzero(1.0 - (a + b) * x / (a + 1.0));
  double fraction = d;
  for (int m = 1; m <= most_terms; ++m) {
    const double even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
    d = 1.0 / nonzero(1.0 + even * d);
    c = nonzero(1.0 + even / c);
    fraction *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
    d = 1.0 / nonzero(1.0 + odd * d);
    c = nonzero(1.0 + odd / c);
    fraction *= d * c;
    if (std::abs(d * c - 1.0) < precision) break;
  }
  return fraction;
}

/// x^a (1-x)^b / (a B(a, b)), with y = 1 - x given by itself so that neither loses digits.
double beta_front(double a, double b, double x, double y) {
  return std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log(y)) /
         a;
}

}  // namespace

/// I_x(dof/2, 1/2) with x = dof / (dof + t^2) [DLMF 8.17; Abramowitz and Stegun 26.7.1].
double two_sided_p(double t, double dof) {
  if (t == 0.0) return 1.0;
  const double square = t * t, a = dof / 2.0, b = 0.5;
  if (std::isinf(square)) return 0.0;
  const double x = dof / (dof + square), y = square / (dof + square);
  if (x < (a + 1.0) / (a + b + 2.0)) return beta_front(a, b, x, y) * beta_fraction(a, b, x);
  return 1.0 - beta_front(b, a, y, x) * beta_fraction(b, a, y);
}

}  // namespace lagomorph::render
