#pragma once

#include <cmath>

namespace lagomorph::sim {

/// Sum whose rounding error does not grow with the number of terms, so that the line search can tell energies
/// apart that differ in the last digits. [Neumaier 1974]
class CompensatedSum {
public:
  void add(double x) {
    const double sum = sum_ + x;
    lost_ += std::abs(sum_) >= std::abs(x) ? (sum_ - sum) + x : (x - sum) + sum_;
    sum_ = sum;
  }
  /// An infinite term makes the sum infinite, not NaN.
  double value() const { return std::isfinite(sum_) ? sum_ + lost_ : sum_; }

private:
  double sum_ = 0.0, lost_ = 0.0;
};

}  // namespace lagomorph::sim
