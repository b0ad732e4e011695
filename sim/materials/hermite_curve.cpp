#include "sim/materials/hermite_curve.h"

#include <algorithm>

namespace lagomorph::sim {

namespace {

bool by_x(const HermiteCurve::Knot& a, const HermiteCurve::Knot& b) { return a.x < b.x; }

/// ∫ of the cubic between two knots: h/2 (y_0 + y_1) + h²/12 (m_0 - m_1).
double area(const HermiteCurve::Knot& a, const HermiteCurve::Knot& b) {
  const double h = b.x - a.x;
  return 0.5 * h * (a.y + b.y) + h * h / 12.0 * (a.slope - b.slope);
}

}  // namespace

std::size_t HermiteCurve::origin() const {
  return static_cast<std::size_t>(std::lower_bound(knots_.begin(), knots_.end(), Knot{0.0, 0.0, 0.0}, by_x) -
                                  knots_.begin());
}

void HermiteCurve::set(std::size_t knot, double y, double slope) {
  knots_[knot].y = y;
  knots_[knot].slope = slope;
}

void HermiteCurve::integrate() {
  const std::size_t rest = origin();
  knots_[rest].area = 0.0;
  for (std::size_t i = rest + 1; i < knots_.size(); ++i)
    knots_[i].area = knots_[i - 1].area + area(knots_[i - 1], knots_[i]);
  for (std::size_t i = rest; i-- > 0;) knots_[i].area = knots_[i + 1].area - area(knots_[i], knots_[i + 1]);
}

HermiteCurve::Values HermiteCurve::at(double x) const {
  const auto along = [&](const Knot& end) -> Values {
    const double d = x - end.x;
    return {end.area + d * (end.y + 0.5 * d * end.slope), end.y + d * end.slope, end.slope};
  };
  if (!(x > knots_.front().x)) return along(knots_.front());
  if (x >= knots_.back().x) return along(knots_.back());
  const auto above = std::upper_bound(knots_.begin(), knots_.end(), Knot{x, 0.0, 0.0}, by_x);
  const Knot &a = *(above - 1), &b = *above;
  const double h = b.x - a.x, d = x - a.x, secant = (b.y - a.y) / h;
  const double c2 = (3.0 * secant - 2.0 * a.slope - b.slope) / h;
  const double c3 = (a.slope + b.slope - 2.0 * secant) / (h * h);
  return {a.area + d * (a.y + d * (0.5 * a.slope + d * (c2 / 3.0 + 0.25 * d * c3))),
          a.y + d * (a.slope + d * (c2 + d * c3)), a.slope + d * (2.0 * c2 + 3.0 * d * c3)};
}

}  // namespace lagomorph::sim
