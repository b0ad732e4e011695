#pragma once

#include <array>
#include <string>
#include <vector>

namespace lagomorph::sim {

/// The function of one stretch that makes a Valanis-Landel density meet uniaxial data, by x = log λ.
///
/// T(x) = λ P(λ), the Kirchhoff stress of the data, is a monotone cubic Hermite spline through the points
/// (and the origin, where it is not among them), with slopes by Fritsch and Carlson 1980; beyond the data it
/// goes on along its tangent, as Hencky's material does. When the lateral stretch is λ^(-nu), the sides are
/// free and the axial stress is T for the G with
///   G(x) - G(-nu x) = T(x), so G(x) = Σ_n T((-nu)^n x),
/// a geometric sum, which is closed on the two pieces of T beside 0 and a few terms elsewhere.
class StressStrainCurve {
public:
  /// `data` are (strain, stress), nominal [1, Pa]; with `young` > 0 they are scaled to that modulus at rest.
  /// Throws InputError, prefixed by `where`.
  StressStrainCurve(const std::vector<std::array<double, 2>>& data, double young, double poisson,
                    const std::string& where);

  struct Values {
    double W = 0.0;      // ∫_0^x G [Pa]
    double G = 0.0;      // [Pa]
    double dG_dx = 0.0;  // [Pa]
  };
  Values at(double x) const;

  struct Stress {
    double S = 0.0;      // ∫_0^x T [Pa]
    double T = 0.0;      // [Pa]
    double dT_dx = 0.0;  // [Pa]
  };
  Stress stress(double x) const;

  double poisson() const { return poisson_; }
  double young() const { return young_; }             // T' at rest [Pa]
  double largest_slope() const { return steepest_; }  // of T at the data [Pa]

private:
  struct Knot {
    double x, T, slope;
    double S = 0.0;  // ∫_0^x T
  };
  void set_slopes();
  void close_the_sum_at_rest(std::size_t origin);

  std::vector<Knot> knots_;
  double poisson_, young_ = 0.0, steepest_ = 0.0;
  double low_ = 0.0, high_ = 0.0;                     // where the sum is closed: between these
  std::array<std::array<double, 4>, 2> closed_ = {};  // G = Σ_k c_k x^k, k = 1 .. 3, for x < 0 and x >= 0
};

}  // namespace lagomorph::sim
