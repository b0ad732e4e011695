#pragma once

#include <vector>

#include "sim/types.h"

namespace lagomorph::sim {

/// Samples over time and what is between them: linear, or smooth, a cubic through each with slopes that keep
/// it monotone where the samples are and at rest where they turn, so that it is once differentiable and never
/// overshoots. [Fritsch and Butland 1984] Constant before the first sample and after the last.
class MotionCurve {
public:
  enum class Ends {
    at_rest,    // a smooth curve begins and ends with slope zero
    by_secant,  // with that of the samples beside
  };
  /// `times` ascend [s]; `samples` has a column for each.
  MotionCurve(std::vector<double> times, Eigen::MatrixXd samples, bool is_smooth, Ends);

  VecX at(double t) const;
  /// d/dt. Where a linear curve bends it is that of the motion that arrives there, at the first sample that
  /// of the motion that begins.
  VecX rate(double t) const;

private:
  double length(int i) const {
    return times_[static_cast<std::size_t>(i) + 1] - times_[static_cast<std::size_t>(i)];
  }
  VecX secant(int i) const { return (samples_.col(i + 1) - samples_.col(i)) / length(i); }
  VecX slope(int i) const;
  int last() const { return static_cast<int>(times_.size()) - 1; }

  std::vector<double> times_;
  Eigen::MatrixXd samples_;
  bool is_smooth_;
  Ends ends_;
};

}  // namespace lagomorph::sim
