#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/materials/hermite_curve.h"

namespace lagomorph::sim {

/// The function of one stretch that makes ψ = Σ_i W(x_i) + lambda/2 (Σ_i x_i)², x = log λ, meet uniaxial
/// data.
///
/// T(x) = λ P(λ), the Kirchhoff stress of the data, is a monotone cubic spline through the points (and the
/// origin, where it is not among them), with slopes by Fritsch and Butland 1984; beyond the data it goes on
/// along its tangent, as Hencky's material does. Sides that are free at the lateral y(x) carry
///   lambda (x + 2y) + G(y) = 0, G = W',  and the axis  G(x) + lambda (x + 2y) = T(x),
/// so G(x) = T(x) + G(y(x)): from the origin outwards, for |y| < |x|. At rest G' = 2 mu and y' = -nu, and
/// lambda is Lamé's for the data's modulus and Poisson's ratio; further out the ratio is what follows. G is
/// found at the data, and at many knots around them; between knots it is cubic, T to some 1e-5 of the
/// largest.
class StressStrainCurve {
public:
  /// `data` are (strain, stress), nominal [1, Pa]; with `young` > 0 they are scaled to that modulus at rest.
  /// Throws InputError, prefixed by `where`.
  StressStrainCurve(const std::vector<std::array<double, 2>>& data, double young, double poisson,
                    const std::string& where);

  /// area: W [Pa], y: G [Pa], slope: dG/dx [Pa].
  HermiteCurve::Values at(double x) const { return density_.at(x); }
  /// The data: y: T [Pa], slope: dT/dx [Pa].
  HermiteCurve::Values stress(double x) const { return stress_.at(x); }
  /// y(x), log of the stretch of free sides.
  double lateral(double x) const;

  double lambda() const { return lambda_; }           // [Pa]
  double poisson() const { return poisson_; }         // at rest
  double young() const { return young_; }             // T' at rest [Pa]
  double largest_slope() const { return steepest_; }  // of T at the data [Pa]

private:
  void find_density();

  HermiteCurve stress_, density_;
  double poisson_, young_ = 0.0, lambda_ = 0.0, steepest_ = 0.0;
};

}  // namespace lagomorph::sim
