#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sim/types.h"

namespace lagomorph::sim {

/// The names of the kernels: biharmonic, triharmonic, gaussian.
std::vector<std::string> radial_kernel_names();

/// s(x) = Σ_i w_i φ(|x - x_i|) + p(x), equal to the values at the control points. With Σ_i w_i times every
/// monomial of p zero, p is
///   biharmonic    φ = r, p a constant: no width to tune, bounded far from the points;
///   triharmonic   φ = r³, p linear: the smoothest, linear fields are kept, and it grows far away;
///   gaussian      φ = exp(-(r/radius)²), p the mean of the values, to which it decays.
/// Over control points of a body at rest as in [Bickel et al. 2009, "Capture and Modeling of Non-Linear
/// Heterogeneous Soft Tissue"]; solvable by [Wendland 2005, "Scattered Data Approximation", Chapter 8]
class RadialBasis {
public:
  /// Throws InputError, prefixed by `where`: unknown kernel, other numbers of points and values, points that
  /// coincide or do not determine p.
  RadialBasis(std::vector<Vec3> points, const std::vector<double>& values, const std::string& kernel,
              std::optional<double> radius, const std::string& where);

  double operator()(const Vec3& x) const;

private:
  double phi(double r) const;
  int monomials() const;  // of p: 1 or 4
  double monomial(int k, const Vec3&) const;

  enum class Kernel { biharmonic, triharmonic, gaussian };
  Kernel kernel_ = Kernel::biharmonic;
  std::vector<Vec3> points_;  // about their mean, in units of their extent, so that the system is well scaled
  Vec3 mean_ = Vec3::Zero();
  double extent_ = 1.0;  // [m]
  double radius_ = 1.0;  // likewise in units of the extent
  Eigen::VectorXd weights_, polynomial_;
};

}  // namespace lagomorph::sim
