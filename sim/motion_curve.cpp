#include "sim/motion_curve.h"

#include <algorithm>
#include <utility>

namespace lagomorph::sim {

MotionCurve::MotionCurve(std::vector<double> times, Eigen::MatrixXd samples, bool is_smooth, Ends ends)
    : times_(std::move(times)), samples_(std::move(samples)), is_smooth_(is_smooth), ends_(ends) {}

/// Of the smooth curve at sample i: a weighted harmonic mean of the secants beside it, zero where they differ
/// in sign.
VecX MotionCurve::slope(int i) const {
  if (i == 0 || i == last()) {
    if (ends_ == Ends::at_rest) return VecX::Zero(samples_.rows());
    return secant(i == 0 ? 0 : last() - 1);
  }
  const double h0 = length(i - 1), h1 = length(i);
  const VecX d0 = secant(i - 1), d1 = secant(i);
  return d0.binaryExpr(d1, [&](double a, double b) {
    return a * b > 0.0 ? 3.0 * (h0 + h1) / ((2.0 * h1 + h0) / a + (h1 + 2.0 * h0) / b) : 0.0;
  });
}

VecX MotionCurve::at(double t) const {
  if (t <= times_.front()) return samples_.col(0);
  if (t >= times_.back()) return samples_.col(last());
  const int i = static_cast<int>(std::upper_bound(times_.begin(), times_.end(), t) - times_.begin()) - 1;
  const double h = length(i), s = (t - times_[static_cast<std::size_t>(i)]) / h;
  const VecX rise = samples_.col(i + 1) - samples_.col(i);
  if (!is_smooth_) return samples_.col(i) + s * rise;
  return samples_.col(i) + s * s * (3.0 - 2.0 * s) * rise +
         h * s * (1.0 - s) * ((1.0 - s) * slope(i) - s * slope(i + 1));
}

VecX MotionCurve::rate(double t) const {
  constexpr double slack = 1e-9;  // steps add up to a sample's time but for rounding [s]
  if (times_.size() == 1 || t < times_.front() - slack || t > times_.back() + slack)
    return VecX::Zero(samples_.rows());
  const auto behind = std::lower_bound(times_.begin(), times_.end(), t - slack);
  const int i = std::clamp(static_cast<int>(behind - times_.begin()) - 1, 0, last() - 1);
  if (!is_smooth_) return secant(i);
  const double s = (t - times_[static_cast<std::size_t>(i)]) / length(i);
  return 6.0 * s * (1.0 - s) * secant(i) + (1.0 - s) * (1.0 - 3.0 * s) * slope(i) +
         s * (3.0 * s - 2.0) * slope(i + 1);
}

}  // namespace lagomorph::sim
