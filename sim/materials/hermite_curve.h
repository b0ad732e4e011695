#pragma once

#include <vector>

namespace lagomorph::sim {

/// A function of one variable by values and slopes at knots, cubic between them and along its tangents beyond
/// the last ones; with its integral from 0.
class HermiteCurve {
public:
  struct Knot {
    double x, y, slope;
    double area = 0.0;  // ∫_0^x; integrate() sets it
  };
  struct Values {
    double area = 0.0;  // ∫_0^x
    double y = 0.0;
    double slope = 0.0;
  };

  HermiteCurve() = default;
  /// One knot at least, by growing x, x = 0 among them.
  explicit HermiteCurve(std::vector<Knot> knots) : knots_(std::move(knots)) { integrate(); }

  Values at(double x) const;
  const std::vector<Knot>& knots() const { return knots_; }
  /// The number of the knot at 0.
  std::size_t origin() const;

  /// Gives a knot another value and slope; integrate() must follow, or `area` is that of before.
  void set(std::size_t knot, double y, double slope);
  void integrate();

private:
  std::vector<Knot> knots_;
};

}  // namespace lagomorph::sim
