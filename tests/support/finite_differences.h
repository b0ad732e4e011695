#pragma once

#include <cmath>

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace lagomorph::sim {

inline double norm_of(double x) { return std::abs(x); }
template <class Derived>
double norm_of(const Eigen::MatrixBase<Derived>& x) {
  return x.norm();
}

/// The central difference of f at t = 0 goes to `derivative`, and its error by the square of the step: a
/// wrong derivative has an error that stays, a sloppy one an error that does not fall fourfold. Where f is
/// linear the error is none but rounding.
/// `has_kinks`: the derivative itself has, and the larger step may cross one, so that its error may be
/// larger.
template <class Function, class Value>
void expect_second_order(const Function& f, const Value& derivative, bool has_kinks = false) {
  const auto error = [&](double step) {
    const Value difference = (f(step) - f(-step)) / (2.0 * step);
    return norm_of(Value(difference - derivative));
  };
  const double scale = norm_of(derivative) + norm_of(f(0.0)), coarse = error(4e-3), fine = error(1e-3);
  if (coarse < 1e-11 * scale) {
    EXPECT_LT(fine, 1e-10 * scale);
    return;
  }
  EXPECT_LT(coarse, 1e-2 * scale);
  if (has_kinks) {
    EXPECT_LT(fine, coarse / 13.9) << "errors " << coarse << ", " << fine;
    return;
  }
  EXPECT_NEAR(std::log2(coarse / fine) / 2.0, 2.0, 0.05) << "errors " << coarse << ", " << fine;
}

}  // namespace lagomorph::sim
